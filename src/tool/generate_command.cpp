// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "output/mesh_stl.h"
#include "tool/mesh_json.h"
#include "tool/number_options.h"
#include "tool/output_file.h"
#include "tool/shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>

namespace lsdcd {

namespace {

struct Output {
  std::string file;
  double edge = 0;
  int segments = 0;
  bool json = false;
};

// More segments would make corners equal in the floats of an STL file.
constexpr int kMaxSegments = 100000;

// Segments of a circle: those of the option, or 64, or as many as the length of edges needs.
int segments_of(const Output &o, double radius)
{
  if (o.segments > 0) return o.segments;
  const double needed = o.edge > 0 ? std::ceil(2 * kPi * radius / (kAcross * o.edge)) : 0;
  return static_cast<int>(std::clamp<double>(needed, 64, kMaxSegments));
}

void write(const Output &o, const Triangles &coarse)
{
  check_outputs({{"--output", o.file, ".stl"}});
  TriangleSoup soup;
  soup.source = o.file;
  for (const auto &t : o.edge > 0 ? refined(coarse, o.edge) : coarse)
    for (const Vec3 &corner : t) soup.corners.push_back(rounded_as_in_stl(corner));
  const WeldedMesh mesh = weld(soup, -1);
  // The shape is so fine, or so long and thin, that welding would merge its corners.
  if (!problems_of(mesh.report).empty())
    throw InputError(o.file + " is not written, because it would not be clean:" +
                     verdict_line(mesh.report).substr(13) +
                     "; is one of its lengths below 1e-6 of the whole? Give a larger --edge or "
                     "fewer --segments");
  write_whole_file(o.file, stl_bytes(soup));
  if (o.json)
    print_json(stdout, as_json(mesh.report));
  else
    std::printf("%s\n%s\n", describe(mesh.report, o.file).c_str(),
                verdict_line(mesh.report).c_str());
}

// Is `value` less than `limit`, so that the shape exists?
void need_less(const char *option, double value, const std::string &what, double limit)
{
  if (value < limit) return;
  char text[160];
  std::snprintf(text, sizeof text, "%s is %g, and has to be less than %s, %g", option, value,
                what.c_str(), limit);
  throw InputError(text);
}

// Subcommands with the options that all shapes have.
class Shapes {
 public:
  explicit Shapes(Command &generate) : generate_(generate), command_(generate) {}

  Command add(const char *name, const char *text, const char *example)
  {
    command_ = generate_.command(name, text);
    command_.footer(std::string("Example:\n  lsdcd generate ") + name + " " + example);
    o_ = std::make_shared<Output>();
    command_.option("-o,--output", o_->file, "STL file to write, binary").required();
    length("--edge", o_->edge, "no edge is longer than this (default: as few triangles as can be)");
    command_.flag("--json", o_->json, "print JSON");
    return command_;
  }
  void length(const char *option, double &value, const char *text, bool needed = false)
  {
    const auto positive = [](const std::string &word) -> std::string {
      double x = 0;
      return is_number(word, &x) && x > 0 && x < 1e30 ? ""
                                                      : "'" + word + "' is not a length above 0";
    };
    Option added = command_.option(option, value, text).check(positive, "LENGTH");
    if (needed)
      added.required();
    else if (value > 0)
      added.shows_default();
  }
  void round()
  {
    command_
        .option("--segments", o_->segments,
                "sides of the polygon that a circle is (default: 64, more where --edge asks)")
        .range(3, kMaxSegments);
  }
  std::shared_ptr<Output> output() const { return o_; }

 private:
  Command generate_, command_;    // the second: the last that was added
  std::shared_ptr<Output> o_;
};

struct Sizes {
  double width = 0, depth = 0, height = 0, length = 0, radius = 0, top = 0, outlet = 0, cone = 0,
         tube = 0, knuckle = 0, shaft = 0, pitch = 0, thickness = 0, stub = 0;
  int number = 0;
  bool flag = false;
};

void add_flat(Shapes &shapes)
{
  const auto s = std::make_shared<Sizes>();
  Command plane = shapes.add("plane", "a rectangle about the origin at z = 0, facing up; open",
                             "--width 0.2 --depth 0.1 --edge 0.01 -o floor.stl");
  shapes.length("--width", s->width, "along x", true);
  shapes.length("--depth", s->depth, "along y", true);
  plane.runs([o = shapes.output(), s] { write(*o, plane_shape(s->width, s->depth, o->edge)); });

  Command box = shapes.add("box", "from the origin to (width, depth, height); closed",
                           "--width 0.2 --depth 0.1 --height 0.3 -o box.stl");
  shapes.length("--width", s->width, "along x", true);
  shapes.length("--depth", s->depth, "along y", true);
  shapes.length("--height", s->height, "along z", true);
  box.runs([o = shapes.output(), s] {
    write(*o, box_shape({s->width, s->depth, s->height}, o->edge));
  });
}

void turn(const Output &o, Profile profile, bool open, double radius)
{
  if (!open) {
    if (profile.front().r > 0) profile.insert(profile.begin(), {0, profile.front().z});
    if (profile.back().r > 0) profile.push_back({0, profile.back().z});
  }
  write(o, turned(profile, segments_of(o, radius), o.edge));
}

void add_round(Shapes &shapes)
{
  const auto s = std::make_shared<Sizes>();
  Command cylinder = shapes.add("cylinder", "about the z axis from z = 0 on; closed",
                                "--radius 0.05 --height 0.2 --open -o tube.stl");
  shapes.length("--radius", s->radius, "its radius", true);
  shapes.length("--height", s->height, "along z", true);
  shapes.round();
  cylinder.flag("--open", s->flag, "without its ends");
  cylinder.runs([o = shapes.output(), s] {
    turn(*o, {{s->radius, 0}, {s->radius, s->height}}, s->flag, s->radius);
  });

  Command cone = shapes.add("cone", "about the z axis from z = 0 on, or a frustum; closed",
                            "--radius 0.05 --top 0.02 --height 0.1 -o cone.stl");
  shapes.length("--radius", s->radius, "at z = 0", true);
  shapes.length("--top", s->top, "radius at the top (default: a tip)");
  shapes.length("--height", s->height, "along z", true);
  shapes.round();
  cone.flag("--open", s->flag, "without its ends");
  cone.runs([o = shapes.output(), s] {
    turn(*o, {{s->radius, 0}, {s->top, s->height}}, s->flag, std::max(s->radius, s->top));
  });
}

void add_bins(Shapes &shapes)
{
  const auto s = std::make_shared<Sizes>();
  Command hopper = shapes.add(
      "hopper", "a bin above a cone with an outlet at z = 0; open, a wall without thickness",
      "--radius 0.1 --height 0.3 --cone 0.1 --outlet 0.03 --edge 0.01 -o hopper.stl");
  shapes.length("--radius", s->radius, "radius of the bin", true);
  shapes.length("--height", s->height, "height of the bin, above the cone", true);
  shapes.length("--cone", s->cone, "height of the cone (default: a flat floor)");
  shapes.length("--outlet", s->outlet, "radius of the outlet", true);
  shapes.round();
  hopper.runs([o = shapes.output(), s] {
    need_less("--outlet", s->outlet, "--radius", s->radius);
    turn(*o, {{s->outlet, 0}, {s->radius, s->cone}, {s->radius, s->cone + s->height}}, true,
         s->radius);
  });

  Command vessel = shapes.add(
      "vessel",
      "a cylinder above a cone above a tube that ends at z = 0, with rounded\n"
      "knuckles between them; open, a wall without thickness",
      "--radius 50 --height 100 --cone 50 --outlet 15 --tube 30 --knuckle 12 -o vessel.stl");
  shapes.length("--radius", s->radius, "of the cylinder", true);
  shapes.length("--height", s->height, "of the cylinder", true);
  shapes.length("--cone", s->cone, "height of the cone", true);
  shapes.length("--outlet", s->outlet, "radius of the tube", true);
  shapes.length("--tube", s->tube, "length of the tube", true);
  shapes.length("--knuckle", s->knuckle, "radius of the roundings (default: none)");
  shapes.round();
  vessel.runs([o = shapes.output(), s] {
    need_less("--outlet", s->outlet, "--radius", s->radius);
    const Profile p = {{s->outlet, 0},
                       {s->outlet, s->tube},
                       {s->radius, s->tube + s->cone},
                       {s->radius, s->tube + s->cone + s->height}};
    Profile line = {p[0]};
    // As fine as the circles are.
    const int segments = segments_of(*o, s->radius), steps = std::max(2, segments / 16);
    for (int i = 1; i <= 2; i++)
      for (const RadiusHeight &q : rounded_corner(p[i - 1], p[i], p[i + 1], s->knuckle, steps))
        line.push_back(q);
    line.push_back(p[3]);
    turn(*o, line, true, s->radius);
  });
}

void add_machines(Shapes &shapes)
{
  const auto s = std::make_shared<Sizes>();
  Command drum = shapes.add(
      "drum", "a drum about the y axis from y = 0 on, with lifters; open at its ends",
      "--radius 0.5 --length 0.3 --lifters 8 --height 0.05 --thickness 0.03 -o drum.stl");
  shapes.length("--radius", s->radius, "radius of the drum", true);
  shapes.length("--length", s->length, "along y", true);
  drum.option("--lifters", s->number, "how many (default: none)").range(2, 1000);
  shapes.length("--height", s->height, "height of a lifter (default: a tenth of the radius)");
  shapes.length("--thickness", s->thickness,
                "thickness of a lifter (default: a twentieth of the radius)");
  shapes.round();
  drum.flag("--closed", s->flag, "with its ends");
  drum.runs([o = shapes.output(), s] {
    DrumShape d = {s->radius,
                   s->length,
                   s->number,
                   s->height,
                   s->thickness,
                   s->flag,
                   segments_of(*o, s->radius),
                   o->edge};
    if (d.height == 0) d.height = d.radius / 10;
    if (d.width == 0) d.width = d.radius / 20;
    if (d.lifters > 0) {
      need_less("--height", d.height, "--radius", d.radius);
      need_less("--thickness", d.width, "the space that lifters leave each other at their tips",
                2 * (d.radius - d.height) * std::tan(kPi / d.lifters));
      need_less("--thickness", d.width, "--radius", d.radius);
    }
    write(*o, drum_shape(d));
  });

  Command screw = shapes.add(
      "screw", "a shaft along y from y = 0 on, with a right-handed blade; closed",
      "--radius 0.06 --shaft 0.015 --pitch 0.1 --turns 3 --thickness 0.004 -o screw.stl");
  shapes.length("--radius", s->radius, "radius of the blade", true);
  shapes.length("--shaft", s->shaft, "radius of the shaft", true);
  shapes.length("--pitch", s->pitch, "length that the blade advances in a turn", true);
  shapes.length("--thickness", s->thickness, "thickness of the blade, along y", true);
  shapes.length("--stub", s->stub,
                "length of shaft before and after the blade (default: a tenth of a pitch)");
  screw.option("--turns", s->number, "turns of the blade").required().range(1, 1000);
  shapes.round();
  screw.runs([o = shapes.output(), s] {
    need_less("--shaft", s->shaft, "--radius", s->radius);
    need_less("--thickness", s->thickness, "--pitch", s->pitch);
    write(*o, screw_shape({s->radius, s->shaft, s->pitch, s->thickness,
                           s->stub > 0 ? s->stub : s->pitch / 10, s->number,
                           segments_of(*o, s->radius), o->edge}));
  });
}

}    // namespace

void add_generate_command(Command &program)
{
  Command generate = program.command("generate", "writes the mesh of a simple shape");
  generate.needs_a_command();
  generate.footer("lsdcd generate SHAPE --help lists the sizes of a shape.\n"
                  "Example:\n  lsdcd generate box --width 2 --depth 1 --height 1 -o box.stl");
  Shapes shapes(generate);
  add_flat(shapes);
  add_round(shapes);
  add_bins(shapes);
  add_machines(shapes);
}

}    // namespace lsdcd
