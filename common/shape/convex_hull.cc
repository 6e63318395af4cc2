#include "common/shape/convex_hull.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace talus {
namespace {

// Frees what qhull holds, whichever way the function is left.
class QhullState {
 public:
  QhullState() : messages_(open_memstream(&text_, &length_)) { qh_zero(&state_, messages_); }
  ~QhullState() {
    int memory_blocks = 0;
    int memory_bytes = 0;
    state_.NOerrexit = True;
    qh_freeqhull(&state_, False);
    qh_memfreeshort(&state_, &memory_blocks, &memory_bytes);
    std::fclose(messages_);
    std::free(text_);
  }
  QhullState(const QhullState&) = delete;
  QhullState& operator=(const QhullState&) = delete;

  qhT* get() { return &state_; }
  // Qhull's messages go here instead of to the terminal.
  FILE* messages() { return messages_; }

 private:
  char* text_ = nullptr;
  std::size_t length_ = 0;
  FILE* messages_;
  qhT state_{};
};

// qhull lists a face's corners clockwise seen from outside (qh_ORIENTclock 0): read from the last to the first.
std::vector<std::vector<int>> read_faces(qhT* qh) {
  std::vector<std::vector<int>> faces;
  for (facetT* facet = qh->facet_list; facet != nullptr && facet->next != nullptr; facet = facet->next) {
    setT* vertices = qh_facet3vertex(qh, facet);
    std::vector<int> face;
    for (int i = qh_setsize(qh, vertices) - 1; i >= 0; --i)
      face.push_back(qh_pointid(qh, static_cast<vertexT*>(vertices->e[i].p)->point));
    qh_settempfree(qh, &vertices);
    faces.push_back(std::move(face));
  }
  return faces;
}

}  // namespace

std::vector<std::vector<int>> convex_hull_faces(std::span<const Vec3> points) {
  std::vector<double> coordinates;
  coordinates.reserve(points.size() * 3);
  double largest = 0.0;
  for (const Vec3& point : points) {
    coordinates.insert(coordinates.end(), point.begin(), point.end());
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
  }
  if (points.size() < 4) return {};
  // Corners that were turned lie off their face by more rounding than qhull itself allows for.
  std::string command = fmt::format("qhull C-{}", 1e-13 * largest);
  QhullState qhull;
  const int error = qh_new_qhull(qhull.get(), 3, static_cast<int>(points.size()), coordinates.data(), False,
                                 command.data(), nullptr, qhull.messages());
  return error == qh_ERRnone ? read_faces(qhull.get()) : std::vector<std::vector<int>>{};
}

}  // namespace talus
