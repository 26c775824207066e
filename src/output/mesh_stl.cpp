#include "output/mesh_stl.h"

#include "base/whole_file.h"

#include <cstdint>
#include <cstring>

namespace lsdcd {

namespace {

// STL is little-endian whatever the machine is.
void append(std::string &bytes, std::uint32_t number)
{
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 255);
}

void append(std::string &bytes, const Vec3 &a)
{
  for (const Real x : {a.x, a.y, a.z}) {
    const float value = static_cast<float>(x);
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    append(bytes, bits);
  }
}

// volatile: g++ 12 with -O3 makes double -> float -> double of two neighbours at once no change.
Real rounded(Real x)
{
  const volatile float value = static_cast<float>(x);
  return value;
}

}    // namespace

Vec3 rounded_as_in_stl(const Vec3 &corner)
{
  return {rounded(corner.x), rounded(corner.y), rounded(corner.z)};
}

void write_mesh_stl(const std::string &path, const WallMesh &mesh, const WallPose &pose)
{
  constexpr std::size_t kHeaderText = 80;
  std::string bytes = "binary STL of lsdcd";    // no "solid", by which text begins
  bytes.resize(kHeaderText, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.faces.size()));
  for (const auto &f : mesh.faces) {
    Vec3 corner[3];
    for (int k = 0; k < 3; k++) {
      corner[k] = rounded_as_in_stl(pose.to_box(mesh.vertices[f[k]]));
    }
    // Of the corners as they are in the file, so that reading and writing it changes nothing.
    const Vec3 n = cross(corner[1] - corner[0], corner[2] - corner[0]);
    append(bytes, norm_sq(n) > 0 ? (1 / norm(n)) * n : n);
    for (const Vec3 &c : corner) append(bytes, c);
    bytes.append(2, '\0');    // attributes
  }
  WholeFile file(path);
  file.write_at(0, bytes.data(), bytes.size());
  file.commit();
}

}    // namespace lsdcd
