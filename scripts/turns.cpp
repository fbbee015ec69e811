// Makes several programs draw frames in turns. compare_builds.py compiles this file to a library and loads it
// into every program with LD_PRELOAD. The speed of a shared machine changes within seconds. A turn lasts only
// about 0.15 s, so each change of the speed affects all programs.
//
// The programs share one mapped file. A program may draw only while it has the turn. It passes the turn on
// between two frames, outside the timed interval. pelage stops the timing of a frame when clFinish() returns.
// After that, pelage calls clGetEventProfilingInfo(). This file replaces clGetEventProfilingInfo() by a
// version that passes the turn on if the turn has lasted at least TURN_SECONDS. After the last frame, a
// program calls clEnqueueReadBuffer() to read its picture back. This file also replaces
// clEnqueueReadBuffer(): the new version first waits until all programs have drawn their frames, because
// pelage then checks the picture, and this check uses all cores.
//
// Environment: TURN_FILE: path of the shared file, which has at least 64 bytes, all 0. TURN_ID: number of
// this program, from 0. TURN_COUNT: number of programs. TURN_SECONDS: shortest duration of a turn.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>

namespace {

struct Shared {
  std::atomic<int> changes;  // increases with every change of the other members; waiting programs watch it
  std::atomic<int> turn;     // number of the program that may draw
  std::atomic<int> arrived;  // bit i: program i has drawn its first frame
  std::atomic<int> done;     // bit i: program i has drawn all frames
};

Shared* shared = nullptr;
int own = 0, count = 1;
double least_s = 0;
bool frame_ended = false, joined = false, left = false;
std::chrono::steady_clock::time_point turn_began;

void announce() {
  ++shared->changes;
  syscall(SYS_futex, &shared->changes, FUTEX_WAKE, count, nullptr, nullptr, 0);
}

template <class Condition>
void wait_until(Condition holds) {
  while (true) {
    const int seen = shared->changes.load();
    if (holds()) return;
    const timespec longest{1, 0};
    syscall(SYS_futex, &shared->changes, FUTEX_WAIT, seen, &longest, nullptr, 0);
  }
}

// Maps the shared file at the first call. Returns false if TURN_FILE is not set.
bool take_part() {
  static const bool mapped = [] {
    const char* file = std::getenv("TURN_FILE");
    if (!file) return false;
    const int descriptor = ::open(file, O_RDWR);
    void* memory = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (descriptor < 0 || memory == MAP_FAILED) std::abort();
    shared = static_cast<Shared*>(memory);
    own = std::atoi(std::getenv("TURN_ID"));
    count = std::atoi(std::getenv("TURN_COUNT"));
    least_s = std::atof(std::getenv("TURN_SECONDS"));
    return true;
  }();
  return mapped;
}

void pass_the_turn() {
  int next = own;
  do next = (next + 1) % count;
  while (next != own && (shared->done.load() >> next & 1) != 0);
  shared->turn = next;
  announce();
}

void wait_for_the_turn() {
  wait_until([] { return shared->turn.load() == own; });
  turn_began = std::chrono::steady_clock::now();
}

void between_frames() {
  if (!joined) {
    joined = true;
    shared->arrived.fetch_or(1 << own);
    announce();
    wait_until([] { return shared->arrived.load() == (1 << count) - 1; });
    wait_for_the_turn();
  } else if (std::chrono::duration<double>(std::chrono::steady_clock::now() - turn_began).count() >=
             least_s) {
    pass_the_turn();
    wait_for_the_turn();
  }
}

template <class Function>
Function* next_definition(Function*, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

// Each function below replaces the function of the same name in the OpenCL loader, and calls the replaced
// function.

extern "C" cl_int clFinish(cl_command_queue queue) {
  static auto* const original = next_definition(&clFinish, "clFinish");
  frame_ended = true;
  return original(queue);
}

extern "C" cl_int clGetEventProfilingInfo(cl_event event, cl_profiling_info what, size_t size, void* value,
                                          size_t* needed) {
  static auto* const original = next_definition(&clGetEventProfilingInfo, "clGetEventProfilingInfo");
  if (take_part() && frame_ended && !left) {
    frame_ended = false;
    between_frames();
  }
  return original(event, what, size, value, needed);
}

extern "C" cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset,
                                      size_t size, void* to, cl_uint count_of_events, const cl_event* events,
                                      cl_event* event) {
  static auto* const original = next_definition(&clEnqueueReadBuffer, "clEnqueueReadBuffer");
  if (take_part() && joined && !left) {
    left = true;
    shared->done.fetch_or(1 << own);
    pass_the_turn();
    wait_until([] { return shared->done.load() == (1 << count) - 1; });
  }
  return original(queue, buffer, blocking, offset, size, to, count_of_events, events, event);
}
