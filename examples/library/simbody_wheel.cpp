// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wheel with a motor drives over a bed of grains: Simbody moves the wheel, the library has the forces between it and
// the grains. simbody_wheel [SECONDS [elastic]]
//
// Both programs make the same steps: half a kick, a drift, the forces, half a kick. So what the wheel gives the grains it
// takes from them in the same step. The program prints two books over both, and ends with 1 where one is not closed:
// linear and angular momentum against what gravity, motor and tray gave, and energy against what the motor gave. With
// `elastic` nothing is lost in contacts. Writes wheel.svg. Units are SI; y is up, the wheel turns about z.
#undef NDEBUG    // Debian's Simbody is built without it, and classes of its headers differ by it
#include <Simbody.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <lsdcd.hpp>
#include <string>
#include <vector>

namespace {

using SimTK::SpatialVec, SimTK::Vec3;
using Three = std::array<double, 3>;

constexpr double kPi = 3.14159265358979323846, kGravity = 9.81;
constexpr double kGrain = 3e-3, kGrainMass = 2500 * 4 / 3. * kPi * kGrain * kGrain * kGrain;
constexpr double kStiffness = 1e4, kFriction = 0.5, kDt = 1e-5;
constexpr double kRadius = 0.04, kLug = 0.006, kWidth = 0.024, kMass = 0.3, kTorque = 0.03;
constexpr double kLength = 0.24, kDepth = 0.032, kHeight = 0.06;
constexpr int kLugs = 12;

// The quads of a mesh in triangles.
lsdcd::Mesh mesh_of(const std::vector<double> &vertices,
                    const std::vector<std::array<std::uint32_t, 4>> &quads)
{
  std::vector<std::uint32_t> faces;
  for (const auto &q : quads)
    for (const int k : {0, 1, 2, 0, 2, 3}) faces.push_back(q[k]);
  return lsdcd::Mesh(vertices, faces);
}

// A box without its lid.
lsdcd::Mesh tray()
{
  std::vector<double> vertices;
  for (int k = 0; k < 8; k++)
    for (const double x : {k & 1 ? kLength : 0, k & 2 ? kHeight : 0, (k & 4 ? 0.5 : -0.5) * kDepth})
      vertices.push_back(x);
  return mesh_of(vertices, {{0, 4, 5, 1}, {0, 1, 3, 2}, {4, 6, 7, 5}, {0, 2, 6, 4}, {1, 5, 7, 3}});
}

// Corner i of its outline.
Vec3 rim(int i)
{
  const double a = 2 * kPi * i / (4 * kLugs), r = i % 4 < 2 ? kRadius : kRadius - kLug;
  return {r * std::cos(a), r * std::sin(a), 0};
}

// Closed; its origin is its centre.
lsdcd::Mesh wheel()
{
  constexpr std::uint32_t n = 4 * kLugs;
  std::vector<double> vertices;
  std::vector<std::array<std::uint32_t, 4>> quads;
  for (std::uint32_t i = 0; i <= n; i++)    // last the middle
    for (const double z : {-0.5 * kWidth, 0.5 * kWidth}) {
      const Vec3 x = i < n ? rim(static_cast<int>(i)) : Vec3(0);
      for (const double number : {x[0], x[1], z}) vertices.push_back(number);
    }
  for (std::uint32_t i = 0; i < n; i++) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
    quads.push_back({a, b, b + 1, a + 1});
    if (i % 2 == 0) {    // two neighbours and the middle
      const std::uint32_t c = 2 * ((i + 2) % n);
      quads.push_back({2 * n, c, b, a});
      quads.push_back({2 * n + 1, a + 1, b + 1, c + 1});
    }
  }
  return mesh_of(vertices, quads);
}

// Spheres that push one another by a spring, a dashpot and friction without memory.
struct Grains {
  std::vector<Vec3> x, v, omega, force, torque;
  std::vector<double> radius, mass;
  std::vector<std::pair<int, int>> near;
  std::vector<Vec3> listed_at;
  double damping, friction, elastic = 0;    // the energy in springs between them

  explicit Grains(bool is_elastic) :
      damping(is_elastic ? 0 : 0.4 * std::sqrt(kStiffness * kGrainMass)),
      friction(is_elastic ? 0 : kFriction)
  {
    const double side = 2.02 * kGrain;
    for (int k = 0; k < 4; k++)
      for (int i = 0; (i + 1) * side < kLength; i++)
        for (int j = -2; j <= 2 && !(k % 2 && j == 2); j++)
          x.push_back(Vec3((i + 0.5) * side + 1e-5 * (k + j), (0.5 + 0.88 * k) * side,
                           (j + 0.5 * (k % 2)) * side));
    v = omega = force = torque = std::vector<Vec3>(x.size(), Vec3(0));
    radius.assign(x.size(), kGrain);
    mass.assign(x.size(), kGrainMass);
  }
  double inertia() const { return 0.4 * kGrainMass * kGrain * kGrain; }

  void list()
  {
    constexpr double kRoom = 0.3 * kGrain;
    double most = listed_at.empty() ? kRoom : 0;
    for (std::size_t i = 0; i < listed_at.size(); i++)
      most = std::max(most, (x[i] - listed_at[i]).norm());
    if (most < kRoom / 2) return;
    listed_at = x;
    near.clear();
    for (std::size_t i = 0; i < x.size(); i++)
      for (std::size_t j = 0; j < i; j++)
        if ((x[i] - x[j]).normSqr() < std::pow(2 * kGrain + kRoom, 2)) near.emplace_back(i, j);
  }

  void push_each_other()
  {
    list();
    elastic = 0;
    for (const auto &[i, j] : near) {
      const Vec3 between = x[i] - x[j];
      const double distance = between.norm(), overlap = 2 * kGrain - distance;
      if (overlap <= 0) continue;
      const Vec3 normal = between / distance;
      const double arm = kGrain - overlap / 2;
      const Vec3 u = v[i] - v[j] - arm * ((omega[i] + omega[j]) % normal);
      const double push = kStiffness * overlap - damping * SimTK::dot(u, normal);
      const Vec3 slip = u - SimTK::dot(u, normal) * normal;
      const double speed = slip.norm() + 1e-12,
                   rub = std::min(friction * std::fabs(push), damping * speed);
      const Vec3 f = push * normal - (rub / speed) * slip, turn = -arm * (normal % f);
      force[i] += f;
      force[j] -= f;
      torque[i] += turn;
      torque[j] += turn;
      elastic += 0.5 * kStiffness * overlap * overlap;
    }
  }

  void push(lsdcd::Wall &wall, bool setup)
  {
    std::fill(torque.begin(), torque.end(), Vec3(0));
    std::fill(force.begin(), force.end(), Vec3(0, -kGravity * kGrainMass, 0));
    push_each_other();
    lsdcd_spheres s = {};
    s.size = sizeof s;
    s.n = x.size();
    s.x = &x[0][0];
    s.v = &v[0][0];
    s.omega = &omega[0][0];
    s.radius = radius.data();
    s.mass = mass.data();
    s.force = &force[0][0];
    s.torque = &torque[0][0];
    lsdcd_wall_step step = {};
    step.size = sizeof step;
    step.dt = kDt;
    step.setup = setup;
    wall.step(s, step);
  }
  void kick(double dt)
  {
    for (std::size_t i = 0; i < x.size(); i++) {
      v[i] += dt / kGrainMass * force[i];
      omega[i] += dt / inertia() * torque[i];
    }
  }
  void drift()
  {
    for (std::size_t i = 0; i < x.size(); i++) x[i] += kDt * v[i];
  }
  double energy() const
  {
    double sum = elastic;
    for (std::size_t i = 0; i < x.size(); i++)
      sum += 0.5 * kGrainMass * v[i].normSqr() + 0.5 * inertia() * omega[i].normSqr() +
             kGravity * kGrainMass * x[i][1];
    return sum;
  }
  SpatialVec momentum() const    // about the origin
  {
    SpatialVec sum(Vec3(0), Vec3(0));
    for (std::size_t i = 0; i < x.size(); i++)
      sum += SpatialVec(inertia() * omega[i] + x[i] % (kGrainMass * v[i]), kGrainMass * v[i]);
    return sum;
  }
  SpatialVec weight() const
  {
    SpatialVec sum(Vec3(0), Vec3(0));
    for (const Vec3 &place : x) {
      const Vec3 f(0, -kGravity * kGrainMass, 0);
      sum += SpatialVec(place % f, f);
    }
    return sum;
  }
};

// Simbody's: a wheel that moves in the plane of x and y.
class Vehicle {
 public:
  Vehicle() :
      matter_(system_), forces_(system_), gravity_(forces_, matter_, Vec3(0, -kGravity, 0)),
      grains_(forces_, matter_), wheel_(matter_.updGround(), body())
  {
    SimTK::Force::MobilityConstantForce(forces_, wheel_, SimTK::MobilizerUIndex(0), -kTorque);
    state_ = system_.realizeTopology();
    wheel_.setQFromVector(state_, SimTK::Vector(Vec3(0, 0.06, 7.4 * kGrain + kRadius)));
    system_.realize(state_, SimTK::Stage::Velocity);
  }
  // Its wrench about its centre.
  void set_force(const SpatialVec &wrench) { grains_.setOneBodyForce(state_, wheel_, wrench); }
  void kick(double dt)
  {
    system_.realize(state_, SimTK::Stage::Acceleration);
    const SimTK::Vector change = dt * state_.getUDot();
    state_.updU() += change;
    system_.realize(state_, SimTK::Stage::Velocity);
  }
  void drift()
  {
    const SimTK::Vector change = kDt * state_.getQDot();
    state_.updQ() += change;
    system_.realize(state_, SimTK::Stage::Velocity);
  }
  lsdcd::Pose pose() const
  {
    const SimTK::Transform &at = wheel_.getBodyTransform(state_);
    const SpatialVec &moves = wheel_.getBodyVelocity(state_);
    const SimTK::Quaternion turn = at.R().convertRotationToQuaternion();
    lsdcd::Pose pose;
    for (int k = 0; k < 3; k++) {
      pose.position[k] = at.p()[k];
      pose.angular_velocity[k] = moves[0][k];
      pose.velocity[k] = moves[1][k];
    }
    for (int k = 0; k < 4; k++) pose.quaternion[k] = turn[k];
    return pose;
  }
  const Vec3 &centre() const { return wheel_.getBodyOriginLocation(state_); }
  SpatialVec moves() const { return wheel_.getBodyVelocity(state_); }
  double energy() const
  {
    return matter_.calcKineticEnergy(state_) + kGravity * kMass * centre()[1];
  }
  SpatialVec momentum() const { return matter_.calcSystemMomentumAboutGroundOrigin(state_); }

 private:
  static SimTK::Body::Rigid body()
  {
    const double about = 0.5 * kMass * kRadius * kRadius;
    return SimTK::Body::Rigid(
        SimTK::MassProperties(kMass, Vec3(0), SimTK::Inertia(about / 2, about / 2, about)));
  }

  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  SimTK::Force::UniformGravity gravity_;
  SimTK::Force::DiscreteForces grains_;
  SimTK::MobilizedBody::Planar wheel_;
  SimTK::State state_;
};

// What goes in the plane: x and y of forces, z of torques.
struct Book {
  Three missing = {0, 0, 0};
  double size = 0;    // of all that was given

  void add(const SpatialVec &what, double times)
  {
    const Three terms = {times * what[1][0], times * what[1][1], times * what[0][2]};
    for (int k = 0; k < 3; k++) {
      missing[k] += terms[k];
      size += std::fabs(terms[k]);
    }
  }
};

SpatialVec wrench(lsdcd::Wall &wall, int mesh, const Vec3 &about)
{
  const lsdcd_wall_totals w = wall.totals(mesh, {about[0], about[1], about[2]});
  return SpatialVec(Vec3(w.torque[0], w.torque[1], w.torque[2]),
                    Vec3(w.force[0], w.force[1], w.force[2]));
}

void draw(const Grains &grains, const Vehicle &vehicle, double seconds)
{
  constexpr double kFastest = 0.1;    // the end of the colours, m/s
  std::ofstream svg("wheel.svg");
  const auto x = [](double number) { return 10 + 2500 * number; };
  const auto y = [](double number) { return 2500 * (2 * kHeight - number) + 65; };
  svg << "<svg xmlns='http://www.w3.org/2000/svg' width='620' height='370' font-family='DejaVu "
         "Sans, sans-serif' "
         "font-size='18'>\n<rect width='620' height='370' fill='white' stroke='none'/>\n";
  const auto bar = [&](double left, double top, double width, double height,
                       const std::string &fill = "black") {
    svg << "<rect x='" << left << "' y='" << top << "' width='" << width << "' height='" << height
        << "' fill='" << fill << "' stroke='none'/>\n";
  };
  const auto text = [&](double at, double base, const std::string &what, const char *anchor) {
    svg << "<text stroke='none' x='" << at << "' y='" << base << "' text-anchor='" << anchor << "'>"
        << what << "</text>\n";
  };
  const auto colour = [](double speed) {
    const int blue = static_cast<int>(255 - 200 * std::min(1., speed / kFastest));
    return "rgb(230," + std::to_string(blue / 2 + 90) + "," + std::to_string(blue) + ")";
  };
  bar(x(0) - 4, y(kHeight), 4, y(0) - y(kHeight));
  bar(x(kLength), y(kHeight), 4, y(0) - y(kHeight));
  bar(x(0) - 4, y(0), x(kLength) - x(0) + 8, 4);
  for (std::size_t i = 0; i < grains.x.size(); i++)
    svg << "<circle cx='" << x(grains.x[i][0]) << "' cy='" << y(grains.x[i][1]) << "' r='"
        << 2500 * kGrain << "' stroke='black' stroke-width='0.4' fill='"
        << colour(grains.v[i].norm()) << "'/>\n";
  const lsdcd::Pose pose = vehicle.pose();
  const double a = 2 * std::atan2(pose.quaternion[3], pose.quaternion[0]);
  svg << "<polygon fill='silver' fill-opacity='0.8' stroke='black' stroke-width='2' points='";
  for (int i = 0; i < 4 * kLugs; i++) {
    const Vec3 p = rim(i);
    svg << x(pose.position[0] + std::cos(a) * p[0] - std::sin(a) * p[1]) << ','
        << y(pose.position[1] + std::sin(a) * p[0] + std::cos(a) * p[1]) << ' ';
  }
  svg << "'/>\n";
  // An arrow for the way that the motor turns the wheel: a quarter of a circle from above the hub to its right, in short
  // lines, since some programs fill a path that is only to be stroked.
  const double cx = x(pose.position[0]), cy = y(pose.position[1]), r = 1250 * kRadius;
  constexpr int kLines = 30;
  for (int k = 0; k < kLines; k++) {
    const double from = kPi / 2 * k / kLines, to = kPi / 2 * (k + 1) / kLines;
    svg << "<line x1='" << cx + r * std::sin(from) << "' y1='" << cy - r * std::cos(from)
        << "' x2='" << cx + r * std::sin(to) << "' y2='" << cy - r * std::cos(to)
        << "' stroke='black' stroke-width='3'/>\n";
  }
  svg << "<polygon stroke='none' points='" << cx + r - 8 << ',' << cy - 2 << ' ' << cx + r + 8
      << ',' << cy - 2 << ' ' << cx + r << ',' << cy + 14 << "'/>\n";
  std::array<char, 40> time;
  std::snprintf(time.data(), time.size(), "t = %.2f s", seconds);
  text(10, 24, time.data(), "start");
  bar(10, 40, 2500 * 0.02, 4);
  text(20 + 2500 * 0.02, 48, "20 mm", "start");
  text(610, 24, "speed of a grain, m/s", "end");
  constexpr int kSteps = 40, kStep = 5;
  for (int k = 0; k < kSteps; k++)
    bar(410 + k * kStep, 32, kStep + 0.5, 14, colour((k + 0.5) / kSteps * kFastest));
  text(410, 64, "0", "middle");
  text(610, 64, "0.1 or more", "end");
  svg << "</svg>\n";
}

int drive(double seconds, bool is_elastic)
{
  const double damping = is_elastic ? 0 : 2000, friction = is_elastic ? 0 : kFriction;
  lsdcd::Wall wall(
      "hooke/history $law log brief  mesh $tray  mesh $wheel motion caller",
      {{"law", {kStiffness, is_elastic ? 0 : 0.8 * kStiffness, damping, damping / 2, friction, 1}},
       {"tray", tray()},
       {"wheel", wheel()}});
  const int of_tray = wall.mesh("tray"), of_wheel = wall.mesh("wheel");
  Grains grains(is_elastic);
  Vehicle vehicle;

  const auto forces = [&](bool setup) {
    wall.set_pose(of_wheel, vehicle.pose());
    grains.push(wall, setup);
    vehicle.set_force(wrench(wall, of_wheel, vehicle.centre()));
  };
  Book book;
  double by_motor = 0, turned_over = 0;
  const SpatialVec motor(Vec3(0, 0, -kTorque), Vec3(0));
  const auto kick = [&] {
    const Vec3 f(0, -kGravity * kMass, 0);
    for (const SpatialVec &given : {grains.weight(), SpatialVec(vehicle.centre() % f, f), motor,
                                    SpatialVec(-1. * wrench(wall, of_tray, Vec3(0)))})
      book.add(given, kDt / 2);
    book.size += kDt / 2 * wrench(wall, of_wheel, Vec3(0)).norm();
    const double before = vehicle.moves()[0][2];
    grains.kick(kDt / 2);
    vehicle.kick(kDt / 2);
    by_motor -= kDt / 2 * kTorque * 0.5 * (before + vehicle.moves()[0][2]);
  };
  forces(true);
  const auto energy = [&] {
    return grains.energy() + vehicle.energy() + wall.totals().elastic_energy;
  };
  const double first = energy();
  book.add(grains.momentum() + vehicle.momentum(), 1);
  double stored = grains.elastic + wall.totals().elastic_energy;
  const int steps = static_cast<int>(std::lround(seconds / kDt));
  for (int k = 0; k < steps; k++) {
    kick();
    grains.drift();
    vehicle.drift();
    forces(false);
    kick();
    const double now = grains.elastic + wall.totals().elastic_energy;
    turned_over += std::fabs(now - stored);
    stored = now;
  }
  book.add(grains.momentum() + vehicle.momentum(), -1);
  const double lost = first + by_motor - energy();
  draw(grains, vehicle, seconds);
  std::printf("the wheel went %.3g mm and turned %.3g degrees\n",
              1e3 * (vehicle.centre()[0] - 0.06),
              -std::atan2(vehicle.pose().quaternion[3], vehicle.pose().quaternion[0]) * 360 / kPi);
  std::printf("momentum: %.2g %.2g N s, angular %.2g N m s are missing of %.3g\n", book.missing[0],
              book.missing[1], book.missing[2], book.size);
  std::printf(
      "energy: %.3g J were lost in contacts, the motor gave %.3g J, %.3g J went through springs\n",
      lost, by_motor, turned_over);
  // Each step sums as many numbers as there are grains, none larger than all that was given.
  const double rounding = static_cast<double>(grains.x.size()) * 2.3e-16 * book.size;
  bool closed = true;
  for (const double number : book.missing) closed &= std::fabs(number) <= rounding;
  // An oscillation of frequency w has an energy that is wrong by (w dt)^2/8 of it, and that of two grains is the fastest.
  const double wrong = 2 * kStiffness / kGrainMass * kDt * kDt / 8 * turned_over;
  closed &= is_elastic ? std::fabs(lost) <= wrong : lost >= -wrong;
  return closed ? 0 : 1;
}

}    // namespace

int main(int argc, char **argv)
try {
  return drive(argc > 1 ? std::atof(argv[1]) : 0.5,
               argc > 2 && std::strcmp(argv[2], "elastic") == 0);
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
