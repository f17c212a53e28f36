// VTK reports errors to its observers, and to the terminal where there is none.
#pragma once
#include <vtkCallbackCommand.h>
#include <vtkObject.h>
#include <vtkSmartPointer.h>

namespace voussoir {

/// An observer that notes the error and keeps VTK from printing it: our own message says more. `failed` must outlive
/// it.
inline vtkSmartPointer<vtkCallbackCommand> error_flag(bool& failed) {
  auto command = vtkSmartPointer<vtkCallbackCommand>::New();
  command->SetClientData(&failed);
  command->SetCallback([](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
  return command;
}

/// Keeps VTK's pipeline, which has no observer of ours, from printing as long as the object lives.
class Silence {
 public:
  Silence() : before_(vtkObject::GetGlobalWarningDisplay()) { vtkObject::GlobalWarningDisplayOff(); }
  ~Silence() { vtkObject::SetGlobalWarningDisplay(before_); }
  Silence(const Silence&) = delete;

 private:
  int before_;
};

}  // namespace voussoir
