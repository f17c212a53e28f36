#include "viz/offscreen.h"

#include <vtkImageData.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <span>

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/folder.h"

namespace voussoir {
namespace {

/// Mean of each kOversampling × kOversampling square of pixels.
vtkSmartPointer<vtkImageData> averaged(vtkImageData* large) {
  const int* size = large->GetDimensions();
  const int width = size[0] / kOversampling, height = size[1] / kOversampling;
  auto small = vtkSmartPointer<vtkImageData>::New();
  small->SetDimensions(width, height, 1);
  small->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto* from = static_cast<const unsigned char*>(large->GetScalarPointer());
  auto* to = static_cast<unsigned char*>(small->GetScalarPointer());
  constexpr int area = kOversampling * kOversampling;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel) {
        int sum = area / 2;
        for (int dy = 0; dy < kOversampling; ++dy)
          for (int dx = 0; dx < kOversampling; ++dx)
            sum += from[((y * kOversampling + dy) * size[0] + x * kOversampling + dx) * 3 + channel];
        *to++ = static_cast<unsigned char>(sum / area);
      }
  return small;
}

}  // namespace

vtkSmartPointer<vtkRenderWindow> offscreen_window(int width, int height) {
  if (width < 64 || height < 64 || width > 8000 || height > 8000)
    throw InputError("pictures: the size is {} × {} pixels. Width and height must be 64 to 8000", width, height);
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);  // we average ourselves, the same way with every driver
  window->SetSize(width * kOversampling, height * kOversampling);
  return window;
}

void write_png(vtkRenderWindow* window, const std::string& path) {
  window->Render();
  auto grab = vtkSmartPointer<vtkWindowToImageFilter>::New();
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  grab->ShouldRerenderOff();
  grab->SetInputBufferTypeToRGB();
  grab->Update();
  const auto picture = averaged(grab->GetOutput());
  make_folder_of(path);
  // Written to memory first, because VTK reports disk errors only on the terminal.
  auto writer = vtkSmartPointer<vtkPNGWriter>::New();
  writer->WriteToMemoryOn();
  writer->SetInputData(picture);
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (writer->GetErrorCode() != 0 || !bytes) throw RunError("{}: VTK could not assemble the picture", path);
  write_atomically(path, std::as_bytes(std::span(bytes->GetPointer(0), std::size_t(bytes->GetNumberOfValues()))));
}

}  // namespace voussoir
