#include "tool/accuracy_command.h"

#include "base/input_error.h"
#include "study/one_triangle.h"
#include "study/paper_values.h"
#include "tool/accuracy_rows.h"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace lsdcd {

namespace {

struct AccuracyOptions {
  std::vector<std::string> tables = {"table2"};
  std::vector<std::string> devices = {"auto"}, orders = {"random"};
  // Of those that `tessellation` tries, the one that gives the paper's Table 2.
  CylinderMesh shape;
  Real cube = 100, largest = 1;
  double spheres = 1e7, most_spheres = 0, most_triangles = 1e5, memory = 16384;
  bool rim_caps = false;
  std::string inside = "exact";
  std::uint64_t seed = 1;
  int repeats = 5;
  std::string csv, commit = LSDCD_COMMIT;
};

const std::vector<std::string> kTables = {"tessellation", "table2",   "figure9", "figure10",
                                          "one-triangle", "formula5", "mesh"};

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

  // Which cylinder and which cube give the paper's best accuracy, and what never finding
  // a contact scores there.
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

Device device_of(const std::string &name)
{
  if (name == "cpu") return Device::cpu;
  if (name == "cuda") return Device::cuda;
  return Device::automatic;
}

void run_accuracy(AccuracyOptions &o)
{
  if (o.rim_caps) o.shape.caps = Caps::rim;
  if (!(o.spheres >= 1) || !(o.spheres < 4294967296.) || !(o.most_spheres < 4294967296.))
    throw InputError("the number of spheres must be from 1 to 4294967295");
  std::vector<std::string> tables = o.tables;
  if (std::find(tables.begin(), tables.end(), "all") != tables.end()) tables = kTables;
  AccuracyRows rows;
  for (const std::string &device : o.devices)
    for (const std::string &order : o.orders) {
      Tables of(o, device_of(device), order == "sorted" ? Order::sorted : Order::random, rows);
      for (const std::string &table : tables) of.make(table);
    }
  if (!o.csv.empty()) {
    rows.write_csv(o.csv);
    std::printf("\n%s\n", o.csv.c_str());
  }
}

const char *kAbout =
    "The paper's study (Yong et al. 2017) with its numbers beside ours. A cylinder of radius 50\n"
    "and height 100 in triangles; spheres uniform in a cube round it, radii uniform in (0, 1].\n"
    "Accuracy is the share of spheres whose status, touching or not, is what the formula of the\n"
    "true cylinder says (its function (3) and formula (6)); error is the loss against the exact\n"
    "wall in per cent (7). missed and false count against the triangles themselves.\n\n"
    "tables:\n"
    "  table2        N = 1, 2, 3 and all triangles, L = 0.2 .. 0.5\n"
    "  figure9       1e3 .. 6e7 spheres (as far as --most-spheres)\n"
    "  figure10      cell lengths 0.179 .. 1; with --device cpu cuda also figures 11 and 12\n"
    "  tessellation  which cylinder and cube the paper may have had\n"
    "  one-triangle  guesses at the paper's row N = 1\n"
    "  formula5      what its inside test costs, on meshes with and without obtuse triangles\n"
    "  mesh          finer cylinders, up to --most-triangles, against their own triangles\n"
    "  all           every one of them";

}    // namespace

void add_accuracy_command(CLI::App &app)
{
  static AccuracyOptions o;
  CLI::App *c = app.add_subcommand("accuracy", kAbout);
  std::vector<std::string> names = kTables;
  names.push_back("all");
  c->add_option("table", o.tables, "tables to make (default: table2)")->check(CLI::IsMember(names));
  c->add_option("--spheres", o.spheres, "how many (1e7 in the paper)")->capture_default_str();
  c->add_option("--most-spheres", o.most_spheres, "where figure9 ends (default: --spheres)");
  c->add_option("--most-triangles", o.most_triangles, "where mesh ends (1e6 takes a GPU)")
      ->capture_default_str();
  c->add_option("--segments", o.shape.segments, "flat sides of the cylinder")
      ->capture_default_str();
  c->add_option("--along", o.shape.along, "rows of triangles along its axis")
      ->capture_default_str();
  c->add_option("--slant", o.shape.slant, "more rows that diagonals climb: obtuse triangles")
      ->capture_default_str();
  c->add_flag("--rim-caps", o.rim_caps, "cut the ends from a corner of the rim: obtuse too");
  c->add_option("--cube", o.cube, "side of the cube that spheres are in")->capture_default_str();
  c->add_option("--radius", o.largest, "largest radius")->capture_default_str();
  c->add_option("--inside", o.inside, "exact, or paper: its formula (5)")
      ->check(CLI::IsMember({"exact", "paper"}))
      ->capture_default_str();
  c->add_option("--order", o.orders, "random, sorted (along a Z-curve) or both")
      ->check(CLI::IsMember({"random", "sorted"}))
      ->expected(1, 2)
      ->capture_default_str();
  c->add_option("--device", o.devices, "auto, cpu, cuda; several one after another")
      ->check(CLI::IsMember({"auto", "cpu", "cuda"}))
      ->expected(1, 2)
      ->capture_default_str();
  c->add_option("--repeats", o.repeats, "timed runs after one to warm up")->capture_default_str();
  c->add_option("--seed", o.seed, "of the spheres")->capture_default_str();
  c->add_option("--memory", o.memory, "budget of a grid in MB")->capture_default_str();
  c->add_option("--csv", o.csv, "write all rows to this file");
  c->add_option("--commit", o.commit, "what was built, for the CSV")->capture_default_str();
  c->footer("CPU runs take OMP_NUM_THREADS threads, one where it is not set.");
  c->callback([] { run_accuracy(o); });
}

}    // namespace lsdcd
