#include "effects/effects.h"

#include "effects_measured.h"

#include <cstdlib>
#include <sstream>

namespace lsdcd {

namespace {

std::vector<std::string> split(const std::string &line)
{
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ';');) fields.push_back(field);
  return fields;
}

struct Kept {
  std::map<std::string, KeptCost> costs;
  std::string where;
};

Kept read_kept()
{
  Kept kept;
  std::istringstream in(kEffectsMeasured);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> heads = split(line);
  while (std::getline(in, line)) {
    std::map<std::string, std::string> row;
    const std::vector<std::string> fields = split(line);
    for (std::size_t k = 0; k < fields.size() && k < heads.size(); k++) row[heads[k]] = fields[k];
    kept.costs[row["name"]] = {std::atof(row["min_ns"].c_str()), std::atof(row["over_ns"].c_str())};
    kept.where = row["device"] + " at " + row["commit"];
  }
  return kept;
}

const Kept &kept()
{
  static const Kept once = read_kept();
  return once;
}

}    // namespace

const std::map<std::string, KeptCost> &kept_costs()
{
  return kept().costs;
}

std::string kept_costs_where()
{
  return kept().where;
}

}    // namespace lsdcd
