// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/accuracy_rows.h"

#include "tool/csv_file.h"

#include <cstdio>
#include <ctime>

namespace lsdcd {

namespace {

std::string number(const char *format, double value)
{
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Returns the day, in UTC, on which a row is made.
std::string today()
{
  const std::time_t now = std::time(nullptr);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
  return text;
}

// Empty where there is nothing.
std::string known(const char *format, double value)
{
  return value < 0 ? "" : number(format, value);
}

const char *kColumns =
    "table,note,device,commit,date,shape,triangles,cube,largest_radius,spheres,seed,order,inside,"
    "length,lists,accuracy,paper_accuracy,best,never,error_percent,paper_error_percent,touching,"
    "missed,false,largest_overlap_error,median_force_error,mean_force_error,certified,entries,"
    "build_s,paper_build_s,grid_bytes,query_ms,query_min_ms,query_max_ms,repeats,paper_query_ms,"
    "upload_ms,download_ms\n";

}    // namespace

std::string lists_name(const StudyLists &lists)
{
  if (lists.every_face) return "every triangle";
  if (lists.nearest == 0) return "complete";
  return std::to_string(lists.nearest);
}

void AccuracyRows::begin(const std::string &title)
{
  std::printf("\n%s\n", title.c_str());
  std::printf("%9s %5s %-14s %9s %9s %8s %8s %8s %7s %9s %9s %8s %9s  %s\n", "spheres", "L",
              "lists", "accuracy", "paper", "error %", "paper", "missed", "false", "certified",
              "query ms", "paper", "grid s", "");
}

void AccuracyRows::add(const RowContext &c, const StudyRow &r, const PaperColumns &paper,
                       const std::string &note)
{
  std::printf("%9zu %5g %-14s %9.6f %9s %8.4f %8s %8zu %7zu %9.6f %9.3f %8s %9.3f  %s\n", r.spheres,
              r.lists.length, lists_name(r.lists).c_str(), r.accuracy,
              known("%.6f", paper.accuracy).c_str(), r.error(), known("%.4f", paper.error).c_str(),
              r.missed, r.false_ones, r.certified, r.query.median_ms,
              known("%.1f", 1e3 * paper.query_s).c_str(), r.build_s, note.c_str());
  std::fflush(stdout);

  std::string line = c.table;
  const auto add = [&](const std::string &value) { line += ',' + value; };
  add(csv_quoted(note));
  add(csv_quoted(r.device));
  add(csv_quoted(c.commit));
  add(today());
  add(csv_quoted(c.shape));
  add(std::to_string(r.triangles));
  add(known("%.10g", c.cube > 0 ? c.cube : -1));
  add(number("%.10g", c.largest));
  add(std::to_string(r.spheres));
  add(std::to_string(c.seed));
  add(c.order);
  add(r.inside == InsideTest::exact ? "exact" : "formula (5)");
  add(number("%.10g", r.lists.length));
  add(lists_name(r.lists));
  add(number("%.8f", r.accuracy));
  add(known("%.6f", paper.accuracy));
  add(number("%.8f", r.best));
  add(number("%.8f", r.never));
  add(number("%.6f", r.error()));
  add(known("%.6f", paper.error));
  add(std::to_string(r.touching));
  add(std::to_string(r.missed));
  add(std::to_string(r.false_ones));
  add(number("%.4g", r.largest_overlap_error));
  add(number("%.4g", r.median_force_error));
  add(number("%.4g", r.mean_force_error));
  add(number("%.8f", r.certified));
  add(number("%.4f", r.entries));
  add(number("%.5g", r.build_s));
  add(known("%.5g", paper.build_s));
  add(std::to_string(r.bytes));
  add(number("%.5g", r.query.median_ms));
  add(number("%.5g", r.query.min_ms));
  add(number("%.5g", r.query.max_ms));
  add(std::to_string(r.query.repeats));
  add(known("%.6g", 1e3 * paper.query_s));
  add(number("%.5g", r.upload_ms));
  add(number("%.5g", r.download_ms));
  csv_ += line + '\n';
}

std::string AccuracyRows::csv() const
{
  return kColumns + csv_;
}

}    // namespace lsdcd
