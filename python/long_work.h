#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>

namespace hoplab::python {

/// Runs `work(stop)` on a thread of its own, without the interpreter's lock, and returns what it
/// returns. Ctrl-C sets `stop`; when the work has ended, KeyboardInterrupt is raised. What `work`
/// throws is thrown here. `work` must not touch Python objects.
template <class Work>
auto RunInterruptibly(const Work& work) {
  std::atomic<bool> stop{false};
  auto result = [&] {
    const pybind11::gil_scoped_release unlocked;
    return std::async(std::launch::async, [&] { return work(&stop); });
  }();
  const auto done = [&] {
    const pybind11::gil_scoped_release unlocked;
    return result.wait_for(std::chrono::milliseconds(20)) == std::future_status::ready;
  };
  while (!done()) {
    if (PyErr_CheckSignals() == 0) continue;
    stop = true;
    {
      const pybind11::gil_scoped_release unlocked;
      result.wait();
    }
    throw pybind11::error_already_set();
  }
  return result.get();
}

}  // namespace hoplab::python
