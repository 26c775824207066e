// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The meshes of a wall as lines or triangles for LAMMPS's dump image.
#ifndef LMP_WALL_PICTURE_H
#define LMP_WALL_PICTURE_H

#include "input/wall_command.h"

#include <vector>

namespace lsdcd {
class Wall;
}

namespace LAMMPS_NS {

class WallPicture {
 public:
  lsdcd::PictureSpec spec;

  bool is_drawn() const { return !objects.empty(); }
  // Sets the objects to draw, on a process that has the meshes, and returns how many there are. Each object is its kind and a row {atom
  // type, corners}; both arrays belong to this class.
  int draw(const lsdcd::Wall &, int *&kinds, double **&rows);

 private:
  std::vector<std::vector<lsdcd::ImageObject>> objects;    // of each mesh, in its own frame
  std::vector<int> kind;
  std::vector<double> data;
  std::vector<double *> row;
};

}    // namespace LAMMPS_NS

#endif
