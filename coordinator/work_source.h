#pragma once

#include <vector>

#include "coordinator/task.h"
#include "storage/rows.h"

namespace swarmsmith {

/// Where tasks come from and outcomes go: a campaign. Pure: no clock, no sockets, no store; what
/// must be written comes out as rows. An abstract class because the cluster's tests put a small
/// campaign of their own behind it.
class WorkSource {
 public:
  virtual ~WorkSource() = default;

  /// Tasks that became wanted since the last call, the most urgent first. Each is returned once.
  virtual std::vector<Task> take_tasks() = 0;

  /// The first outcome of a task that was taken; each task is told once.
  virtual void tell(const Outcome& outcome) = 0;

  /// Rows that became due since the last call, in the order in which they must be stored: an
  /// outcome's own row comes before whatever was decided from it.
  virtual std::vector<Row> take_rows() = 0;

  /// No task is wanted any more, now or later.
  virtual bool finished() const = 0;
};

}  // namespace swarmsmith
