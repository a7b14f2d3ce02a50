#include "postprocess/pictures/scene.hpp"

#include "common/base/error.hpp"
#include "common/base/text.hpp"
#include "common/io/field_writer.hpp"
#include "common/io/run_record.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDataSetMapper.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkDoubleArray.h>
#include <vtkHDFReader.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkOutlineFilter.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkWarpVector.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <limits>

// Xlib defines macros with common names: after everything else.
#include <X11/Xlib.h>

namespace diptych::pictures {
namespace {

constexpr const char* coloured = "coloured";  // name of the array that the colours show

/// VTK aborts the process where it finds no display: connect first, and stay connected until the
/// picture is drawn, since Xvfb starts over, and refuses others meanwhile, when its last client
/// goes.
class DisplayConnection {
 public:
  DisplayConnection() : display_(XOpenDisplay(nullptr)) {
    if (display_ != nullptr) return;
    const char* name = std::getenv("DISPLAY");
    throw base::EnvironmentError(
        fmt::format("no X display {}: VTK draws through X even off screen; run it as `xvfb-run -a "
                    "diptych-picture ...` (packages xvfb, xauth, libgl1-mesa-dri)",
                    name == nullptr ? "(DISPLAY is not set)" : fmt::format("at '{}'", name)));
  }
  DisplayConnection(const DisplayConnection&) = delete;
  DisplayConnection& operator=(const DisplayConnection&) = delete;
  ~DisplayConnection() { XCloseDisplay(display_); }

 private:
  Display* display_;
};

std::vector<std::string> array_names(vtkPointData* fields) {
  std::vector<std::string> names;
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
    names.emplace_back(fields->GetArrayName(i));
  return names;
}

vtkDataArray* field_of(vtkUnstructuredGrid* grid, const std::string& name, const Panel& panel) {
  vtkPointData* fields = grid->GetPointData();
  vtkDataArray* array = fields->GetArray(name.c_str());
  if (array == nullptr) array = fields->GetArray(io::stored_name(name).c_str());
  if (array == nullptr) {
    throw base::InputError(fmt::format("{}: no field '{}'{}", panel.frame_path, name,
                                       base::suggestion(name, array_names(fields))));
  }
  return array;
}

/// Column of a component: an index, a letter of a vector, or two letters of a 3x3 tensor.
int column_of(const std::string& component, int n_components, const std::string& field) {
  int column = -1;
  const auto parsed =
      std::from_chars(component.data(), component.data() + component.size(), column);
  if (parsed.ec != std::errc() || parsed.ptr != component.data() + component.size()) {
    const std::string axes = "xyz";
    const auto axis = [&](size_t i) { return static_cast<int>(axes.find(component[i])); };
    const bool letters = component.find_first_not_of(axes) == std::string::npos;
    if (letters && component.size() == 1 && n_components <= 3) column = axis(0);
    if (letters && component.size() == 2 && n_components == 9) column = 3 * axis(0) + axis(1);
  }
  if (column < 0 || column >= n_components) {
    throw base::InputError(fmt::format(
        "component '{}' of '{}', which has {}: use magnitude, a number from 0 to {}, a letter of "
        "x y z for vectors, or two for 3x3 tensors",
        component, field, n_components, n_components - 1));
  }
  return column;
}

vtkSmartPointer<vtkDoubleArray> colour_values(vtkDataArray* field, const PictureOptions& options) {
  const int n_components = field->GetNumberOfComponents();
  const bool norm = options.component == "magnitude" && n_components > 1;
  const int column = options.component == "magnitude"
                         ? 0
                         : column_of(options.component, n_components, options.field);
  auto values = vtkSmartPointer<vtkDoubleArray>::New();
  values->SetName(coloured);
  values->SetNumberOfValues(field->GetNumberOfTuples());
  for (vtkIdType i = 0; i < field->GetNumberOfTuples(); ++i) {
    double value = norm ? 0 : field->GetComponent(i, column);
    for (int c = 0; norm && c < n_components; ++c)
      value = std::hypot(value, field->GetComponent(i, c));
    values->SetValue(i, value);
  }
  return values;
}

vtkSmartPointer<vtkUnstructuredGrid> read_frame(const Panel& panel, const PictureOptions& options) {
  io::read_file(panel.frame_path);  // says errno, which the reader does not
  vtkNew<vtkHDFReader> reader;
  if (reader->CanReadFile(panel.frame_path.c_str()) == 0) {
    throw base::InputError(fmt::format("{}: VTK cannot read it as VTKHDF", panel.frame_path));
  }
  reader->SetFileName(panel.frame_path.c_str());
  reader->Update();
  vtkSmartPointer<vtkUnstructuredGrid> grid =
      vtkUnstructuredGrid::SafeDownCast(reader->GetOutputAsDataSet());
  if (grid == nullptr || grid->GetNumberOfCells() == 0) {
    throw base::InputError(
        fmt::format("{}: VTK finds no cells; is mesh.hdf beside the frame?", panel.frame_path));
  }
  vtkDataArray* displacement = field_of(grid, "displacement [m]", panel);
  if (displacement->GetNumberOfComponents() != 3) {
    throw base::InputError(fmt::format("{}: 'displacement [m]' must have 3 components, it has {}",
                                       panel.frame_path, displacement->GetNumberOfComponents()));
  }
  const std::string displacement_name = displacement->GetName();
  grid->GetPointData()->AddArray(colour_values(field_of(grid, options.field, panel), options));
  grid->GetPointData()->SetActiveVectors(displacement_name.c_str());
  grid->GetPointData()->SetActiveScalars(coloured);
  return grid;
}

std::array<double, 2> colour_range(const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& grids) {
  std::array<double, 2> range{std::numeric_limits<double>::max(),
                              std::numeric_limits<double>::lowest()};
  for (const auto& grid : grids) {
    double own[2];
    grid->GetPointData()->GetArray(coloured)->GetRange(own);
    range = {std::min(range[0], own[0]), std::max(range[1], own[1])};
  }
  return range;
}

/// Viridis, by nine of its colours: even in lightness, readable without colour vision.
vtkSmartPointer<vtkColorTransferFunction> colour_map(const std::array<double, 2>& range) {
  constexpr std::array<std::array<double, 3>, 9> colours{{{0.267, 0.005, 0.329},
                                                          {0.279, 0.175, 0.483},
                                                          {0.230, 0.322, 0.546},
                                                          {0.173, 0.449, 0.558},
                                                          {0.128, 0.567, 0.551},
                                                          {0.158, 0.684, 0.502},
                                                          {0.369, 0.789, 0.383},
                                                          {0.678, 0.864, 0.190},
                                                          {0.993, 0.906, 0.144}}};
  auto map = vtkSmartPointer<vtkColorTransferFunction>::New();
  const double width =
      range[1] > range[0] ? range[1] - range[0] : 1;  // a constant field: one colour
  for (size_t i = 0; i < colours.size(); ++i) {
    const double place = range[0] + width * static_cast<double>(i) / (colours.size() - 1);
    map->AddRGBPoint(place, colours[i][0], colours[i][1], colours[i][2]);
  }
  return map;
}

vtkSmartPointer<vtkActor> body(vtkUnstructuredGrid* grid,
                               vtkColorTransferFunction* map,
                               const PictureOptions& options) {
  vtkNew<vtkWarpVector> warp;
  warp->SetInputData(grid);
  warp->SetScaleFactor(options.warp);
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputConnection(warp->GetOutputPort());
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputConnection(surface->GetOutputPort());
  normals->SetFeatureAngle(40);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->SetLookupTable(map);
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* look = actor->GetProperty();
  look->SetAmbient(0.5);
  look->SetDiffuse(0.55);
  look->SetEdgeVisibility(options.edges);
  look->SetEdgeColor(0.16, 0.18, 0.22);
  look->SetLineWidth(0.6F);
  return actor;
}

vtkSmartPointer<vtkActor> reference_box(vtkUnstructuredGrid* grid) {
  vtkNew<vtkOutlineFilter> outline;
  outline->SetInputData(grid);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(outline->GetOutputPort());
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.6, 0.63, 0.67);
  actor->GetProperty()->SetLighting(false);
  return actor;
}

vtkSmartPointer<vtkTextActor> label(const std::string& text, int size, double x, double y) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  actor->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  actor->SetPosition(x, y);
  vtkTextProperty* look = actor->GetTextProperty();
  look->SetFontSize(size);
  look->SetFontFamilyToArial();
  look->SetColor(0.12, 0.14, 0.18);
  look->SetJustificationToCentered();
  return actor;
}

vtkSmartPointer<vtkScalarBarActor> scale_of(vtkColorTransferFunction* map) {
  auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
  bar->SetLookupTable(map);
  bar->SetOrientationToHorizontal();
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat("%-#.3g");
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(0.25, 0.12);
  bar->SetPosition2(0.5, 0.6);
  bar->SetUnconstrainedFontSize(true);
  vtkTextProperty* look = bar->GetLabelTextProperty();
  look->SetFontSize(17);
  look->SetFontFamilyToArial();
  look->SetColor(0.12, 0.14, 0.18);
  look->ItalicOff();
  look->BoldOff();
  look->ShadowOff();
  return bar;
}

/// Flat bodies are seen from above; others a little from the side, the third axis up. The body that
/// is far taller than wide fills the panel either way, since the camera is fitted afterwards.
void aim(vtkRenderer* renderer, const PictureOptions& options, bool flat) {
  const std::array<double, 3> towards = options.towards.value_or(
      flat ? std::array<double, 3>{0, 0, 1} : std::array<double, 3>{0.75, -1, 0.4});
  const double length = std::hypot(towards[0], towards[1], towards[2]);
  const bool along_third = std::abs(towards[2]) > 0.99 * length;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(towards[0], towards[1], towards[2]);
  camera->SetViewUp(0, along_third ? 1 : 0, along_third ? 0 : 1);
  camera->SetViewAngle(20);
}

/// A white part of the window.
vtkSmartPointer<vtkRenderer> strip(double left, double bottom, double right, double top) {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetViewport(left, bottom, right, top);
  renderer->SetBackground(1, 1, 1);
  return renderer;
}

/// One camera for all panels, fitted to everything that any panel shows.
void fit(const std::vector<vtkSmartPointer<vtkRenderer>>& renderers) {
  double all[6] = {1e300, -1e300, 1e300, -1e300, 1e300, -1e300};
  for (const auto& renderer : renderers) {
    double own[6];
    renderer->ComputeVisiblePropBounds(own);
    for (int i = 0; i < 6; i += 2) {
      all[i] = std::min(all[i], own[i]);
      all[i + 1] = std::max(all[i + 1], own[i + 1]);
    }
  }
  for (const auto& renderer : renderers)
    renderer->ResetCamera(all);
}

void save(vtkRenderWindow* window, const std::string& path) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(image->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  if (bytes == nullptr || writer->GetErrorCode() != 0) {
    throw base::EnvironmentError(fmt::format("'{}': VTK made no picture", path));
  }
  io::write_file_atomically(path, std::string(reinterpret_cast<const char*>(bytes->GetPointer(0)),
                                              static_cast<size_t>(bytes->GetNumberOfValues())));
}

}  // namespace

void write_picture(const std::string& png_path,
                   const std::vector<Panel>& panels,
                   const PictureOptions& options) {
  vtkObject::GlobalWarningDisplayOff();  // what matters is said by our own errors
  std::vector<vtkSmartPointer<vtkUnstructuredGrid>> grids;
  for (const Panel& panel : panels)
    grids.push_back(read_frame(panel, options));
  const DisplayConnection connection;
  const auto map = colour_map(options.range.value_or(colour_range(grids)));

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->SetSize(options.width, options.height);
  window->SetMultiSamples(8);
  std::vector<vtkSmartPointer<vtkRenderer>> renderers;
  constexpr double foot = 0.13, head = 0.9;  // parts of the height for the scale and the titles
  const auto n = static_cast<double>(panels.size());
  for (size_t i = 0; i < panels.size(); ++i) {
    const double left = static_cast<double>(i) / n;
    const auto scene = strip(left, foot, left + 1 / n, head);
    const double* bounds = grids[i]->GetBounds();
    const bool flat = bounds[5] - bounds[4] <= 1e-9 * grids[i]->GetLength();
    scene->AddActor(body(grids[i], map, options));
    scene->AddActor(reference_box(grids[i]));
    aim(scene, options, flat);
    window->AddRenderer(scene);
    renderers.push_back(scene);
    const auto heading = strip(left, head, left + 1 / n, 1);
    heading->AddActor2D(label(panels[i].title, 26, 0.5, 0.42));
    heading->AddActor2D(label(fmt::format("t = {:.4g} s", panels[i].time), 18, 0.5, 0.06));
    window->AddRenderer(heading);
  }
  fit(renderers);

  const auto footer = strip(0, 0, 1, foot);
  footer->AddActor2D(scale_of(map));
  const std::string suffix = options.component == "magnitude" ? "" : ", " + options.component;
  footer->AddActor2D(label(options.field + suffix, 19, 0.5, 0.76));
  window->AddRenderer(footer);
  window->Render();
  save(window, png_path);
}

}  // namespace diptych::pictures
