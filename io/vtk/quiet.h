// Keeps VTK from printing errors. It prints them to the terminal if it has no observer.
#pragma once
#include <vtkCallbackCommand.h>
#include <vtkObject.h>
#include <vtkSmartPointer.h>

namespace voussoir {

/// An observer that notes an error and keeps VTK from printing it, because the program has its own message. `failed`
/// must outlive it.
inline vtkSmartPointer<vtkCallbackCommand> error_flag(bool& failed) {
  auto command = vtkSmartPointer<vtkCallbackCommand>::New();
  command->SetClientData(&failed);
  command->SetCallback([](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
  return command;
}

/// Keeps the pipeline of VTK, which has no observer, from printing during the lifetime of the object.
class Silence {
 public:
  Silence() : before_(vtkObject::GetGlobalWarningDisplay()) { vtkObject::GlobalWarningDisplayOff(); }
  ~Silence() { vtkObject::SetGlobalWarningDisplay(before_); }
  Silence(const Silence&) = delete;

 private:
  int before_;
};

}  // namespace voussoir
