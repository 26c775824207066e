// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// OBJ, PLY and OFF, by the library assimp.
#include "mesh/io/read_mesh.h"

#include "base/input_error.h"

#include <cmath>
#include <memory>
#include <mutex>

#if defined(LSDCD_HAVE_ASSIMP)
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#endif

namespace lsdcd {

#if defined(LSDCD_HAVE_ASSIMP)
namespace {

void add(const aiMesh &mesh, ReadMesh &read)
{
  for (unsigned f = 0; f < mesh.mNumFaces; f++) {
    const aiFace &face = mesh.mFaces[f];
    if (face.mNumIndices != 3) {
      read.left_out++;
      continue;
    }
    for (unsigned k = 0; k < 3; k++) {
      const aiVector3D &x = mesh.mVertices[face.mIndices[k]];
      if (!std::isfinite(x.x) || !std::isfinite(x.y) || !std::isfinite(x.z))
        throw InputError(read.soup.source + ": a coordinate of facet " +
                         std::to_string(read.soup.n_triangles() + 1) +
                         " is no number, or beyond a float, 3.4e38; mend the file");
      read.soup.corners.push_back({x.x, x.y, x.z});
    }
  }
}

// assimp only logs some errors, such as an index without a vertex, and reads on: "Error, T0: text".
// A missing material is no error of a mesh.
void keep_error(const char *message, char *kept)
{
  const std::string text = message;
  std::string &error = *reinterpret_cast<std::string *>(kept);
  if (error.empty() && text.rfind("Error", 0) == 0 && text.find("material") == text.npos)
    error = text.substr(text.find(": ") + 2, text.find_last_not_of('\n') - text.find(": ") - 1);
}

}    // namespace

// The C interface is the same in other versions of the library.
ReadMesh read_assimp(const std::string &path)
{
  // assimp has one log for all threads and sends every message to all streams.
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  std::string error;
  const aiLogStream log = {keep_error, reinterpret_cast<char *>(&error)};
  aiAttachLogStream(&log);
  const std::unique_ptr<const aiScene, decltype(&aiReleaseImport)> scene(
      aiImportFile(path.c_str(), aiProcess_Triangulate | aiProcess_ValidateDataStructure),
      aiReleaseImport);
  aiDetachLogStream(&log);
  if (!scene) error = aiGetErrorString();
  if (!error.empty()) throw InputError(path + ": cannot be read: " + error);
  ReadMesh read;
  read.soup.source = path;
  for (unsigned m = 0; m < scene->mNumMeshes; m++) add(*scene->mMeshes[m], read);
  if (read.soup.corners.empty())
    throw InputError(path + ": the mesh has no facets; give a mesh with triangles or polygons");
  return read;
}

bool has_assimp()
{
  return true;
}
#else
ReadMesh read_assimp(const std::string &path)
{
  throw InputError(path + ": this lsdcd was built without assimp, which reads OBJ, PLY and OFF; "
                          "give an STL file, or install libassimp-dev and build it again");
}

bool has_assimp()
{
  return false;
}
#endif

}    // namespace lsdcd
