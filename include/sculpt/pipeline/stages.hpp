#pragma once
// Time and peak memory of each stage of a run, over all ranks.
#include <chrono>
#include <string>
#include <vector>

#include "sculpt/base/log.hpp"
#include "sculpt/par/comm.hpp"

namespace sculpt {

// Local. The largest resident memory of this process so far.
[[nodiscard]] std::int64_t peak_kib();

class Stages {
 public:
  Stages();
  // Ends the stage that began with the last call (or the construction) and names it.
  void end(const std::string& name);
  // Collective. A line per stage: slowest rank's time, its share, and the largest peak of resident memory so
  // far.
  void print(const Comm& comm, const Log& log, std::int64_t hexes) const;
  [[nodiscard]] double seconds() const;  // since construction, this rank

 private:
  using Clock = std::chrono::steady_clock;
  struct Stage {
    std::string name;
    double seconds;
    std::int64_t peak_kib;
  };
  Clock::time_point begin_, last_;
  std::vector<Stage> stages_;
};

}  // namespace sculpt
