// The request to octoblisk access, and the study that answers it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "access/access_table.h"
#include "access/contact_site.h"
#include "command_line/grinder_input.h"
#include "grinding/judge.h"
#include "study/run_study.h"

namespace octoblisk::demos {

struct AccessRequest {
  GrinderFiles files;
  double margin = 0.0;  ///< mm
  std::string side = "convex";
  SiteGridOptions grid;
  StudyTarget study;                                            ///< without its file
  double tilt_from = -180.0, tilt_to = 179.0, tilt_step = 1.0;  ///< degrees
  double lead_from = 0.0, lead_to = 0.0, lead_step = 5.0;       ///< degrees
  bool no_picture = false;
  bool report = true;
};

/// Throws std::invalid_argument naming an option that leaves no tilt or lead, or too many.
AccessOptions anglesOf(const AccessRequest& request);

/// The inputs and answers of a map.
struct AccessTask {
  GrinderInput input;
  AccessQuestion question;
  std::vector<ContactSite> sites;
  std::unique_ptr<Judge> judge;
  std::vector<SiteAccess> answered;  ///< per point; a point answered by another process has no tried pose
  std::size_t answered_here = 0;     ///< points
};

/// Fills in everything but the input and the question's angles, which must be set, and the answers. Throws
/// naming the file or the blade if there is nothing to check.
void prepareTask(const AccessRequest& request, AccessTask& task);

/// Everything that the table of points depends on.
Study studyOf(const AccessTask& task);

/// Answers points, which are whole groups of the study, and keeps the answers in the task.
std::vector<AnsweredGroup> answerSites(AccessTask& task, ItemRange items);

}  // namespace octoblisk::demos
