// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Calls with threads in a child of fork(), whose parent has used threads before: the answers are the parent's.
#include "floor_and_grains.h"
#include "points_and_meshes.h"

#include <dirent.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

namespace test_library_fork {
namespace {

constexpr int kThreads = 3;

const lsdcd::Mesh &cylinder()
{
  static const lsdcd::Mesh mesh(numbers(lsdcd::cylinder_mesh(40, 20, 1, 2)));
  return mesh;
}

// Is answer() in a child equal to that of this process? A child that hangs is killed after 20 s.
template <class Answer>
bool is_the_same_in_a_child(const Answer &answer)
{
  const auto wanted = answer();
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    _exit(answer() == wanted ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  return status == 0 && answer() == wanted;    // this process has threads as before
}

std::vector<double> distances_and_sides(const lsdcd::Grid &grid)
{
  const std::vector<double> at = random_points<double>(20000, 2.5);
  std::vector<double> answers(at.size() / 3);
  std::vector<std::int8_t> sides(answers.size());
  lsdcd::Query<double> q(at.data(), answers.size());
  q.threads = kThreads;
  q.distance = answers.data();
  q.side = sides.data();
  grid.query(q);
  answers.insert(answers.end(), sides.begin(), sides.end());
  return answers;
}

// Threads of this process, by the kernel.
int n_threads()
{
  DIR *tasks = opendir("/proc/self/task");
  int n = 0;
  while (const dirent *one = readdir(tasks)) n += one->d_name[0] != '.';
  closedir(tasks);
  return n;
}

TEST(fork, leaves_a_child_the_answers_of_a_query_with_threads)
{
  const lsdcd::Grid grid(cylinder());
  EXPECT_TRUE(is_the_same_in_a_child([&] { return distances_and_sides(grid); }));
}

TEST(fork, leaves_a_child_as_many_threads)
{
  const lsdcd::Grid grid(cylinder());
  EXPECT_TRUE(is_the_same_in_a_child([&] {
    distances_and_sides(grid);
    return n_threads();
  }));
}

TEST(fork, leaves_a_child_of_a_child_the_answers)
{
  const lsdcd::Grid grid(cylinder());
  EXPECT_TRUE(is_the_same_in_a_child(
      [&] { return is_the_same_in_a_child([&] { return distances_and_sides(grid); }); }));
}

TEST(fork, in_a_thread_leaves_its_child_the_answers)
{
  const lsdcd::Grid grid(cylinder());
  distances_and_sides(grid);
  bool is_same = false;
  std::thread([&] {
    is_same = is_the_same_in_a_child([&] { return distances_and_sides(grid); });
  }).join();
  EXPECT_TRUE(is_same);
}

TEST(fork, leaves_a_child_grids_and_contacts)
{
  EXPECT_TRUE(is_the_same_in_a_child([] {
    lsdcd::GridOptions options(0.3);
    options.cell = 0.05;
    options.threads = kThreads;
    const lsdcd::Grid grid(cylinder(), options);
    const std::vector<double> at = random_points<double>(5000, 2.5);
    std::vector<std::size_t> first(at.size() / 3 + 1);
    lsdcd_contacts c = {};
    c.size = sizeof c;
    c.n = first.size() - 1;
    c.threads = kThreads;
    c.points = at.data();
    c.first = first.data();
    lsdcd_contacts_host(grid.get(), &c);
    return first;
  }));
}

TEST(fork, leaves_a_child_bodies_and_collisions)
{
  EXPECT_TRUE(is_the_same_in_a_child([] {
    lsdcd::BodyOptions options;
    options.threads = kThreads;
    lsdcd::Body body(cylinder(), cylinder(), options);
    const double position[3] = {0.3, 0.2, 0.1};
    std::vector<std::uint32_t> wall(100000);
    lsdcd_collision c = {};
    c.size = sizeof c;
    c.threads = kThreads;
    c.position = position;
    c.room = wall.size();
    c.wall_triangle = wall.data();
    lsdcd_collide(body.get(), &c);
    return wall;
  }));
}

class fork_of_a_wall : public FloorTest {};

TEST_F(fork_of_a_wall, leaves_a_child_its_steps)
{
  EXPECT_TRUE(is_the_same_in_a_child([&] {
    lsdcd::WallOptions options;
    options.threads = kThreads;
    lsdcd::Wall wall = floor_wall("", &options);
    Grains grains;
    for (int i = 0; i < 2000; i++) grains.add(0.005 * i - 5, 0.3, 0.49, 0.1);
    grains.step(wall, 3);
    return grains.force;
  }));
}

}    // namespace
}    // namespace test_library_fork
