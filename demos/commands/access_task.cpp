#include "commands/access_task.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "access/access_summary.h"
#include "commands/access_files.h"
#include "models/blade_section.h"
#include "models/blisk_axis.h"
#include "study/node_inputs.h"

namespace octoblisk::demos {
namespace {

constexpr int kMaxAngles = 3600;

int stepsOf(const std::string& name, double from, double to, double step) {
  if (to < from) throw std::invalid_argument("--" + name + "-to: must not be below --" + name + "-from");
  const double steps = std::floor((to - from) / step + 1e-9) + 1.0;
  if (steps > kMaxAngles) {
    throw std::invalid_argument("--" + name + "-step: too small: it makes more than " +
                                std::to_string(kMaxAngles) + " steps");
  }
  return static_cast<int>(steps);
}

bool isForward(const AccessRequest& request, const TriangleMesh& blisk, const BladesFound& blades) {
  if (request.side == "forward" || request.side == "backward") return request.side == "forward";
  const double middle = 0.5 * (blades.root_radius + blades.tip_radius);
  const BladeCutter cutter(blisk, blades, request.grid.blade);
  try {
    return convexIsForward(cutter.at(middle)) == (request.side == "convex");
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(request.files.bliskName() + ": " + error.what() +
                                ", so the convex side is unknown: give --side forward or --side backward");
  }
}

const ClusteredOctree& beltOf(const GrinderInput& input) {
  return *input.tool.parts[input.tool.rules.grinding_part].tree;
}

/// The grid over the side, for a belt with its contact wheel at the origin.
std::vector<ContactSite> gridOf(AccessRequest request, const GrinderInput& input, const TriangleMesh& blisk,
                                int blade) {
  if (input.blades.count == 0) {
    throw std::invalid_argument(request.files.bliskName() +
                                ": no blades were found: give a path with --path");
  }
  request.grid.blade = blade;
  request.grid.forward_side = isForward(request, blisk, input.blades);
  request.grid.wheel_radius = -beltOf(input).mesh().bounds().min.x();
  if (request.grid.wheel_radius <= request.grid.depth) {
    throw std::invalid_argument(request.files.toolName() +
                                ": the belt has no contact wheel at the origin, on its -x side");
  }
  return sitesOnBlade(blisk, input.blades, request.grid);
}

/// The sites of the grid or of the path, in the frame of the blisk's file.
std::vector<ContactSite> sitesAsked(const AccessRequest& request, const GrinderInput& input, int blade,
                                    std::vector<Pose> path) {
  const TriangleMesh blisk = moved(input.blisk->mesh(), input.mesh_in_blisk);
  for (Pose& pose : path) pose = input.mesh_in_blisk * pose;
  std::vector<ContactSite> sites = request.files.path.empty()
                                       ? gridOf(request, input, blisk, blade)
                                       : sitesOfPath(blisk, input.blades, blade, beltOf(input), path);
  const Pose blisk_in_mesh = input.mesh_in_blisk.inverse();
  for (ContactSite& site : sites) {
    site.point = blisk_in_mesh * site.point;
    site.normal = blisk_in_mesh.rotation * site.normal;
    site.base = blisk_in_mesh * site.base;
  }
  return sites;
}

}  // namespace

AccessOptions anglesOf(const AccessRequest& request) {
  AccessOptions options;
  options.tilt_from = request.tilt_from;
  options.tilt_step = request.tilt_step;
  options.tilts = stepsOf("tilt", request.tilt_from, request.tilt_to, request.tilt_step);
  if ((options.tilts - 1) * options.tilt_step > 360.0 - 1e-9) {
    throw std::invalid_argument("--tilt-to: must be less than a full turn beyond --tilt-from");
  }
  options.leads.clear();
  const int leads = stepsOf("lead", request.lead_from, request.lead_to, request.lead_step);
  for (int k = 0; k < leads; ++k) options.leads.push_back(request.lead_from + k * request.lead_step);
  return options;
}

void prepareTask(const AccessRequest& request, AccessTask& task) {
  const GrinderFiles& files = request.files;
  const GrinderInput& input = task.input;
  AccessQuestion& question = task.question;
  question.of_path = !files.path.empty();
  const std::vector<Pose> path =
      question.of_path ? readPath(files.path, *input.blisk).poses() : std::vector<Pose>{};
  question.rules = reachRulesOf(files, input, groundBladeOf(files, input, path).value(), request.margin);
  const int blade = question.rules.ground_blade;
  if (question.of_path && blade == 0) {
    throw std::invalid_argument(
        files.path + ": the belt touches no blade at any pose: name the blade with --ground-blade");
  }
  task.sites = sitesAsked(request, input, blade, path);
  if (task.sites.empty()) {
    throw std::invalid_argument(files.path + ": the belt never comes within 0.5 mm of blade " +
                                std::to_string(blade));
  }
  task.judge = std::make_unique<Judge>(input.blisk, input.tool.parts, input.blades.blade_of_triangle,
                                       question.rules, files.threads, input.fixtures);
}

Study studyOf(const AccessTask& task) {
  Study study;
  study.name = kAccessName;
  study.columns = accessColumns();
  study.items = task.sites.size();
  study.group = kSitesAtOnce;
  std::vector<Pose> sites;
  for (const ContactSite& site : task.sites) {
    sites.push_back(site.base);
    sites.push_back({Mat3::Identity(), site.point});
  }
  study.inputs = {{"blisk", fingerprintOf(task.input.blisk->mesh())},
                  {"points", fingerprintOf(std::span<const Pose>(sites))}};
  for (const ToolPart& part : task.input.tool.parts) {
    std::string word = part.name;
    std::ranges::replace(word, ' ', '_');
    study.inputs.push_back({word, fingerprintOf(part.tree->mesh())});
  }
  for (const Fixture& fixture : task.input.fixtures) {
    std::string word = "obstacle " + fixture.name;
    std::ranges::replace(word, ' ', '_');
    study.inputs.push_back({word, fingerprintOf(fixture.tree->mesh())});
  }
  study.options = lineOf(task.question);
  return study;
}

std::vector<AnsweredGroup> answerSites(AccessTask& task, ItemRange items) {
  const std::vector<ToolPart>& parts = task.input.tool.parts;
  const BodyNames names = task.input.names();
  const auto asked = std::span(task.sites).subspan(items.begin, items.size());
  const std::vector<SiteAccess> found = accessOf(*task.judge, asked, task.question.options);
  task.answered.resize(task.sites.size());
  std::ranges::copy(found, task.answered.begin() + static_cast<std::ptrdiff_t>(items.begin));
  task.answered_here += found.size();
  std::vector<AnsweredGroup> groups;
  for (std::size_t begin = items.begin; begin < items.end; begin += kSitesAtOnce) {
    AnsweredGroup& group = groups.emplace_back();
    group.items = {begin, std::min(items.end, begin + kSitesAtOnce)};
    AccessSummary summary;
    for (std::size_t s = begin; s < group.items.end; ++s) {
      const SiteAccess& access = found[s - items.begin];
      group.rows += rowOfSite(s, task.sites[s], access, task.question, parts, names);
      summary.count(access, parts, names);
    }
    group.tally = tallyOf(summary);
  }
  return groups;
}

}  // namespace octoblisk::demos
