#include "tools/python/module/interrupt.h"

#include <pybind11/pybind11.h>

#include <csignal>

namespace voussoir::python {

namespace py = pybind11;

namespace {

std::atomic<std::atomic<bool>*> watched{nullptr};
std::atomic<bool> pressed{false};
struct sigaction before;

void press(int) {
  pressed.store(true);
  if (std::atomic<bool>* stop = watched.load()) stop->store(true);
}

bool on_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

}  // namespace

InterruptWatch::InterruptWatch(std::atomic<bool>& stop) : watches_(on_main_thread() && watched.load() == nullptr) {
  if (!watches_) return;
  pressed.store(false);
  watched.store(&stop);
  struct sigaction ours {};
  ours.sa_handler = press;
  sigaction(SIGINT, &ours, &before);
}

InterruptWatch::~InterruptWatch() {
  if (!watches_) return;
  sigaction(SIGINT, &before, nullptr);
  watched.store(nullptr);
}

void InterruptWatch::raise_if_pressed() const {
  if (!watches_ || !pressed.load()) return;
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

}  // namespace voussoir::python
