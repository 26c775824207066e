// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/accuracy_tables.h"

#include "study/one_triangle.h"
#include "study/paper_values.h"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace lsdcd {

const std::vector<std::string> kAccuracyTables = {"tessellation", "table2",   "figure9", "figure10",
                                                  "one-triangle", "formula5", "mesh"};

namespace {

// Spheres for the tables that try every triangle or many meshes.
constexpr std::size_t kFewer = 300000;

std::string name_of(const CylinderMesh &shape)
{
  std::string name = "cylinder, " + std::to_string(shape.segments) + " segments, " +
                     std::to_string(shape.along) + " along";
  if (shape.slant > 0) name += ", diagonals over " + std::to_string(shape.slant + 1) + " rows";
  if (shape.caps == Caps::rim) name += ", ends cut from the rim";
  return name;
}

// All tables of one device and one order.
class Tables {
 public:
  Tables(const AccuracyOptions &options, Device device, Order order, AccuracyRows &rows) :
      o_(options), rows_(rows), n_(static_cast<std::size_t>(options.spheres))
  {
    s_.device = device;
    s_.inside = o_.inside == "paper" ? InsideTest::formula_five : InsideTest::exact;
    s_.order = order;
    s_.seed = o_.seed;
    s_.repeats = o_.repeats;
    s_.memory_budget = static_cast<std::size_t>(o_.memory * 1048576);
  }

  void make(const std::string &table)
  {
    context_ = {};
    context_.table = table;
    context_.shape = name_of(o_.shape);
    context_.order = s_.order == Order::random ? "random" : "sorted";
    context_.commit = o_.commit;
    context_.cube = o_.cube;
    context_.largest = o_.largest;
    context_.seed = o_.seed;
    if (table == "tessellation") tessellation();
    if (table == "table2") table2();
    if (table == "figure9") figure9();
    if (table == "figure10") figure10();
    if (table == "one-triangle") one_triangle();
    if (table == "formula5") formula5();
    if (table == "mesh") mesh();
  }

 private:
  static StudyLists nearest(int n, Real length)
  {
    StudyLists lists;
    lists.nearest = n;
    lists.length = length;
    return lists;
  }

  AccuracyStudy study(std::size_t n) const
  {
    AccuracyStudy study(o_.shape, o_.cube, o_.largest, s_);
    study.set_spheres(n);
    return study;
  }
  void title(const std::string &what) { rows_.begin(what + " (" + context_.shape + ")"); }

  // The cylinder and the cube that give the paper's best accuracy, and the score there of never finding
  // a contact.
  void tessellation()
  {
    rows_.begin("Accuracy of the exact wall, by tessellation and cube; the paper's best beside");
    for (Real cube : {100., 101., 102.})
      for (int segments : {36, 38, 39, 40, 41, 42, 44, 48}) {
        CylinderMesh shape = o_.shape;
        shape.segments = segments;
        AccuracyStudy study(shape, cube, o_.largest, s_);
        study.set_spheres(n_);
        context_.shape = name_of(shape);
        context_.cube = cube;
        const StudyRow row = study.measure(nearest(0, 0.5));
        char note[80];
        std::snprintf(note, sizeof note, "%d segments, cube %g; never: %.6f", segments, cube,
                      row.never);
        rows_.add(context_, row, {kPaperBest}, note);
      }
  }

  void table2()
  {
    title("Table 2: accuracy and time of N triangles per cell");
    AccuracyStudy study = this->study(n_);
    for (const PaperAccuracy &p : kPaperTable2) {
      const PaperColumns paper = {p.accuracy, 100 * (kPaperBest - p.accuracy) / kPaperBest,
                                  p.seconds};
      StudyLists lists = nearest(p.n, p.length);
      if (p.n > 0 || s_.inside == InsideTest::exact)
        rows_.add(context_, study.measure(lists), paper);
      if (p.n == 0 && p.length == kPaperTable2[0].length) {
        lists.every_face = true;
        rows_.add(context_, study.measure(lists), paper);
      }
    }
  }

  void figure9()
  {
    title("Figure 9: time and accuracy against the number of spheres, N = 2, L = 0.2");
    AccuracyStudy study(o_.shape, o_.cube, o_.largest, s_);
    const double most = o_.most_spheres > 0 ? o_.most_spheres : o_.spheres;
    for (double n : {1e3, 1e4, 1e5, 1e6, 1e7, 2e7, 3e7, 4e7, 5e7, 6e7}) {
      if (n > most) break;
      PaperColumns paper;
      for (const PaperCount &p : kPaperFigure9)
        if (p.spheres == static_cast<std::size_t>(n)) {
          if (p.accuracy > 0) paper.accuracy = p.accuracy;
          if (p.seconds > 0) paper.query_s = p.seconds;
        }
      study.set_spheres(static_cast<std::size_t>(n));
      rows_.add(context_, study.measure(nearest(2, 0.2)), paper);
    }
  }

  void figure10()
  {
    title("Figures 10 to 12: accuracy, grid and query against the cell length, N = 2");
    AccuracyStudy study = this->study(n_);
    for (double length : {0.179, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
      PaperColumns paper;
      for (const PaperLength &p : kPaperFigure10)
        if (p.length == length) {
          paper.accuracy = p.accuracy;
          paper.error = 100 * (kPaperBest - p.accuracy) / kPaperBest;
          if (p.build_seconds > 0) paper.build_s = p.build_seconds;
        }
      rows_.add(context_, study.measure(nearest(2, length)), paper);
    }
  }

  void one_triangle()
  {
    AccuracyStudy study = this->study(n_);
    std::printf("\nOne triangle per cell: what each guess scores (%s, cube %g, %zu spheres)\n",
                context_.shape.c_str(), o_.cube, n_);
    for (const PaperAccuracy &p : kPaperTable2) {
      if (p.n != 1) continue;
      std::printf("L = %g, the paper: %.6f\n", p.length, p.accuracy);
      const StudyRow row = study.measure(nearest(1, p.length));
      for (const Guess &guess : guess_one_triangle(study, p.length)) {
        StudyRow guessed;
        guessed.device = row.device;
        guessed.triangles = row.triangles;
        guessed.spheres = row.spheres;
        guessed.lists = row.lists;
        guessed.best = row.best;
        guessed.never = row.never;
        guessed.accuracy = guess.accuracy;
        rows_.add(context_, guessed, {p.accuracy}, guess.what);
      }
    }
  }

  void formula5()
  {
    rows_.begin("The exact inside test and the paper's formula (5), every triangle and N = 2");
    const std::size_t n = std::min(n_, kFewer);
    std::vector<CylinderMesh> shapes(1, o_.shape);
    CylinderMesh shape = o_.shape;
    shape.caps = Caps::rim;
    shapes.push_back(shape);
    shape.caps = Caps::centre;
    shape.along = 5;
    for (int slant : {0, 1, 3}) {
      shape.slant = slant;
      shapes.push_back(shape);
    }
    for (const CylinderMesh &s : shapes) {
      context_.shape = name_of(s);
      both_tests(
          [&](const StudySettings &settings) {
            return std::make_unique<AccuracyStudy>(s, o_.cube, o_.largest, settings);
          },
          n);
    }
    context_.shape = "500 triangles at random";
    context_.cube = 0;
    both_tests(
        [&](const StudySettings &settings) {
          return std::make_unique<AccuracyStudy>(random_triangles(500, 20, 5), o_.largest,
                                                 settings);
        },
        n);
  }

  // The figure that matters to a simulation: against the triangles, on finer cylinders.
  void mesh()
  {
    rows_.begin("Against the mesh: missed contacts and force errors of N triangles per cell");
    const struct {
      int segments, along;
    } sizes[] = {{o_.shape.segments, 1}, {100, 49}, {250, 199}, {1000, 499}};
    for (const auto &size : sizes) {
      CylinderMesh shape = o_.shape;
      shape.segments = size.segments;
      shape.along = size.along;
      if (2. * size.segments * (size.along + 1) > o_.most_triangles) continue;
      context_.shape = name_of(shape);
      AccuracyStudy study(shape, o_.cube, o_.largest, s_);
      study.set_spheres(n_);
      for (int n : {1, 2, 3, 4, 8, 0})
        rows_.add(context_, study.measure(nearest(n, 0.4)), {}, context_.shape);
    }
  }

  template <class MakeStudy>
  void both_tests(MakeStudy make_study, std::size_t n)
  {
    for (InsideTest inside : {InsideTest::exact, InsideTest::formula_five}) {
      StudySettings settings = s_;
      settings.inside = inside;
      settings.repeats = 1;
      const auto study = make_study(settings);
      study->set_spheres(n);
      StudyLists lists = nearest(2, 0.2);
      const std::string note =
          context_.shape + (inside == InsideTest::exact ? ", exact" : ", formula (5)");
      rows_.add(context_, study->measure(lists), {}, note);
      lists.every_face = true;
      rows_.add(context_, study->measure(lists), {}, note);
    }
  }

  // In a cube round the origin, corners up to `size` from a point of their own.
  static TriangleSoup random_triangles(int n, Real half, Real size)
  {
    TriangleSoup soup;
    soup.source = "random triangles";
    std::uint64_t k = 0;
    const auto in = [&](Real most) { return most * (2 * uniform(1, k++) - 1); };
    for (int i = 0; i < n; i++) {
      const Vec3 at = {in(half), in(half), in(half)};
      for (int c = 0; c < 3; c++) soup.corners.push_back(at + Vec3{in(size), in(size), in(size)});
    }
    return soup;
  }

  const AccuracyOptions &o_;
  AccuracyRows &rows_;
  std::size_t n_;
  StudySettings s_;
  RowContext context_;
};

}    // namespace

void make_accuracy_tables(const AccuracyOptions &options, const std::vector<std::string> &tables,
                          Device device, Order order, AccuracyRows &rows)
{
  Tables of(options, device, order, rows);
  for (const std::string &table : tables) of.make(table);
}

}    // namespace lsdcd
