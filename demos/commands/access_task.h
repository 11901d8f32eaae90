// What octoblisk access is asked, and the study that is made of it.
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
  StudyTarget study;                                            ///< but for its file
  double tilt_from = -180.0, tilt_to = 179.0, tilt_step = 1.0;  ///< degrees
  double lead_from = 0.0, lead_to = 0.0, lead_step = 5.0;       ///< degrees
  bool no_picture = false;
  bool report = true;
};

/// Throws std::invalid_argument naming an option that leaves no tilt or lead, or too many.
AccessOptions anglesOf(const AccessRequest& request);

/// All that a map is made of.
struct AccessTask {
  GrinderInput input;
  AccessQuestion question;
  std::vector<ContactSite> sites;
  std::unique_ptr<Judge> judge;
  std::vector<SiteAccess> answered;  ///< of each point; a point answered elsewhere has no pose that was tried
  std::size_t answered_here = 0;     ///< points
};

/// Makes all but the answers of the input and the question's angles. Throws naming the file or the blade of
/// which nothing can be asked.
void prepareTask(const AccessRequest& request, AccessTask& task);

/// What the table of points depends on.
Study studyOf(const AccessTask& task);

/// Answers points, which are whole groups of the study, and keeps the answers.
std::vector<AnsweredGroup> answerSites(AccessTask& task, ItemRange items);

}  // namespace octoblisk::demos
