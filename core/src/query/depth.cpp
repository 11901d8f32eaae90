#include "octoblisk/depth.h"

#include "query/depth_search.h"

namespace octoblisk {

DepthQuery::DepthQuery() = default;
DepthQuery::DepthQuery(const DepthQuery&) {}
DepthQuery& DepthQuery::operator=(const DepthQuery&) { return *this; }
DepthQuery::DepthQuery(DepthQuery&&) noexcept = default;
DepthQuery& DepthQuery::operator=(DepthQuery&&) noexcept = default;
DepthQuery::~DepthQuery() = default;

detail::DepthSearch& DepthQuery::search() {
  if (!search_) search_ = std::make_unique<detail::DepthSearch>();
  return *search_;
}

GougeDepth DepthQuery::deepest(const Surface& a, const Surface& b, const Pose& b_in_a, double tolerance,
                               const DepthsSought& sought) {
  return search().deepest(a, b, b_in_a, tolerance, sought);
}

}  // namespace octoblisk
