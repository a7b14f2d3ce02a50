/// A program that uses a part of each library that diptych-picture needs.

#include <vtkHDFReader.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <X11/Xlib.h>

int main() {
  const vtkNew<vtkHDFReader> reader;
  const vtkNew<vtkRenderWindow> window;
  Display* const display = XOpenDisplay(nullptr);
  if (display != nullptr) XCloseDisplay(display);
  return reader->GetClassName() != nullptr && window->GetClassName() != nullptr ? 0 : 1;
}
