// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <mutex>

#include "asterism/optimization/optimizer.hpp"
#include "common.hpp"
#include "signals.hpp"

namespace asterism::app {
namespace {

using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t stop_requested = 0;

std::string text_of_duration(double seconds) {
  const long whole = std::lround(seconds);
  return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

/// One line of progress, redrawn at most ten times a second, or told again every few seconds in a log.
class Meter {
 public:
  explicit Meter(bool bar) : bar_(bar) {}

  void show(std::string_view stage, std::size_t done, std::size_t total) {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    if (stage != stage_ || done < done_) {
      stage_ = stage;
      start_ = now;
      shown_ = {};
    }
    done_ = done;
    if (!due(now, done >= total)) return;
    draw(text(std::chrono::duration<double>(now - start_).count(), total), done >= total);
  }

  /// `share` of the work is done; `rest` says the remainder of the line.
  void show(std::string_view stage, double share, const std::string& rest, bool last) {
    const std::lock_guard lock(mutex_);
    if (due(Clock::now(), last)) draw(fmt::format("{:<12}{}{}", stage, bar_of(share), rest), last);
  }

 private:
  [[nodiscard]] bool due(Clock::time_point now, bool last) {
    const std::chrono::duration<double> since_shown = now - shown_;
    if (!last && since_shown.count() < (bar_ ? 0.1 : 5.0)) return false;
    shown_ = now;
    return true;
  }

  void draw(const std::string& line, bool last) const {
    if (bar_) fmt::print(stderr, "\r\033[K{}{}", line, last ? "\n" : "");
    if (!bar_) fmt::print(stderr, "{}\n", line);
    std::fflush(stderr);
  }

  [[nodiscard]] std::string bar_of(double share) const {
    if (!bar_) return "";
    constexpr int kWidth = 24;
    const int filled = static_cast<int>(std::clamp(share, 0.0, 1.0) * kWidth);
    return fmt::format(" {:━<{}}{:─<{}}", "", filled, "", kWidth - filled);
  }

  [[nodiscard]] std::string text(double elapsed_s, std::size_t total) const {
    const double share = total > 0 ? static_cast<double>(done_) / static_cast<double>(total) : 1.0;
    std::string line = fmt::format("{:<28}{}", stage_, bar_of(share));
    line += fmt::format(" {:3.0f} %  {}/{}", 100 * share, done_, total);
    if (done_ == 0 || elapsed_s <= 0) return line;
    const double rate = static_cast<double>(done_) / elapsed_s;
    line += fmt::format("  {:.3g}/s", rate);
    if (done_ < total)
      line += fmt::format("  {} left", text_of_duration(static_cast<double>(total - done_) / rate));
    if (done_ >= total) line += fmt::format("  in {}", text_of_duration(elapsed_s));
    return line;
  }

  bool bar_;
  std::mutex mutex_;
  std::string stage_;
  std::size_t done_ = 0;
  Clock::time_point start_, shown_;
};

std::shared_ptr<Meter> make_meter(const Common& common) {
  if (common.progress == "none") return nullptr;
  return std::make_shared<Meter>(common.progress == "auto" && isatty(STDERR_FILENO) == 1);
}

}  // namespace

void stop_on_interrupt() {
  // The second Ctrl-C kills: the handler removes itself.
  struct sigaction action {};
  action.sa_handler = [](int) { stop_requested = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool stop_wanted() { return stop_requested != 0; }

Progress make_progress(const Common& common) {
  return [meter = make_meter(common)](std::string_view stage, std::size_t done, std::size_t total) {
    if (stop_wanted()) throw Interrupted();
    if (meter) meter->show(stage, done, total);
  };
}

std::function<void(const Optimizer&)> make_search_progress(const Common& common) {
  return [meter = make_meter(common)](const Optimizer& optimizer) {
    if (!meter || optimizer.history().empty()) return;
    const GenerationRecord& now = optimizer.history().back();
    const double left_s = optimizer.seconds_left();
    const bool last = optimizer.finished();
    std::string rest =
        fmt::format(" generation {}  {} evaluated  hypervolume {:.5g}  {:.0f} % feasible", now.generation,
                    now.evaluations, now.hypervolume, 100 * now.feasible_share);
    if (last) rest += fmt::format("  in {}", text_of_duration(now.seconds));
    if (!last && std::isfinite(left_s)) rest += fmt::format("  {} left", text_of_duration(left_s));
    const double whole_s = now.seconds + left_s;
    meter->show("searching", last ? 1.0 : whole_s > 0 ? now.seconds / whole_s : 0.0, rest, last);
  };
}

}  // namespace asterism::app
