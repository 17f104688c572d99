// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <mutex>

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
    const bool last = done >= total;
    const std::chrono::duration<double> since_shown = now - shown_;
    if (!last && since_shown.count() < (bar_ ? 0.1 : 5.0)) return;
    shown_ = now;
    const std::string line = text(std::chrono::duration<double>(now - start_).count(), total);
    if (bar_) fmt::print(stderr, "\r\033[K{}{}", line, last ? "\n" : "");
    if (!bar_) fmt::print(stderr, "{}\n", line);
    std::fflush(stderr);
  }

 private:
  [[nodiscard]] std::string text(double elapsed_s, std::size_t total) const {
    const double share = total > 0 ? static_cast<double>(done_) / static_cast<double>(total) : 1.0;
    std::string line = fmt::format("{:<28}", stage_);
    if (bar_) {
      constexpr int kWidth = 24;
      const int filled = static_cast<int>(share * kWidth);
      line += fmt::format(" {:━<{}}{:─<{}}", "", filled, "", kWidth - filled);
    }
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

}  // namespace

void stop_on_interrupt() {
  // The second Ctrl-C kills: the handler removes itself.
  struct sigaction action {};
  action.sa_handler = [](int) { stop_requested = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

Progress make_progress(const Common& common) {
  const bool terminal = isatty(STDERR_FILENO) == 1;
  std::shared_ptr<Meter> meter;
  if (common.progress != "none") meter = std::make_shared<Meter>(common.progress == "auto" && terminal);
  return [meter](std::string_view stage, std::size_t done, std::size_t total) {
    if (stop_requested != 0) throw Interrupted();
    if (meter) meter->show(stage, done, total);
  };
}

}  // namespace asterism::app
