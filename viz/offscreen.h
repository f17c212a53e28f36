// From a VTK render window to a PNG file, without a screen.
#pragma once
#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

#include <string>

namespace voussoir {

/// Pictures are drawn this many times larger and averaged down: smooth lines and text on any driver. Line widths and
/// font sizes given to VTK are multiplied by it.
constexpr int kOversampling = 2;

/// A window that is not shown, of kOversampling times `width` × `height` pixels. Throws InputError if the size is not
/// between 64 and 8000 pixels. A Display must exist.
vtkSmartPointer<vtkRenderWindow> offscreen_window(int width, int height);

/// Draws the window and writes the averaged picture atomically. Throws RunError that names the path.
void write_png(vtkRenderWindow* window, const std::string& path);

}  // namespace voussoir
