#pragma once
/// One frame of one run, or of two runs side by side (the diptych), as a PNG: the mesh warped by
/// "displacement [m]", coloured by a field on one common scale, its reference box in outline.
/// Test: tests/pictures/picture_test.cpp

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace diptych::pictures {

/// What one panel shows.
struct Panel {
  std::string title;       ///< above the panel
  std::string frame_path;  ///< a frame_NNNN.hdf
  double time = 0;         ///< s
};

struct PictureOptions {
  std::string field = "velocity [m/s]";
  std::string component = "magnitude";           ///< or x y z, xx xy ... zz, or an index from 0
  double warp = 1;                               ///< factor of the displacement
  bool edges = true;                             ///< draw the edges of cells
  std::optional<std::array<double, 2>> range;    ///< of the colours; of all panels where not given
  std::optional<std::array<double, 3>> towards;  ///< from the body to the eye
  int width = 1400, height = 900;                ///< pixels
};

/// @throws base::InputError for a frame that VTK cannot read or that lacks the field,
///         base::EnvironmentError where there is no X display or the file cannot be written
void write_picture(const std::string& png_path,
                   const std::vector<Panel>& panels,
                   const PictureOptions& options);

}  // namespace diptych::pictures
