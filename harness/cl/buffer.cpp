#include "harness/cl/buffer.hpp"

#include <fmt/format.h>

#include <utility>

#include "harness/error.hpp"

namespace pelage::cl {

Queue::Queue(const Device& device) : device_(device) {
  cl_int code = CL_SUCCESS;
  queue_ = clCreateCommandQueue(device.context(), device.id(), CL_QUEUE_PROFILING_ENABLE, &code);
  check(code, "clCreateCommandQueue");
}

Queue::~Queue() {
  if (queue_ != nullptr) clReleaseCommandQueue(queue_);
}

Queue::Queue(Queue&& other) noexcept
    : device_(std::move(other.device_)), queue_(std::exchange(other.queue_, nullptr)) {}

Queue& Queue::operator=(Queue&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(queue_, other.queue_);
  return *this;
}

void Queue::finish() const {
  check(clFinish(queue_), "clFinish");
}

Memory::Memory(const Device& device, std::size_t bytes) : bytes_(bytes) {
  // Drivers allocate lazily. Without this test, a kernel launch would fail later, with an error that does not
  // name the size.
  if (bytes > device.info().max_allocation)
    throw DeviceError(
        fmt::format("clCreateBuffer: {} MB requested, but {} allocates at most {} MB at once: try a smaller "
                    "picture or mesh, fewer layers or another --device",
                    bytes >> 20, device.info().name, device.info().max_allocation >> 20));
  cl_int code = CL_SUCCESS;
  memory_ = clCreateBuffer(device.context(), CL_MEM_READ_WRITE, bytes > 0 ? bytes : 1, nullptr, &code);
  check(code, fmt::format("clCreateBuffer of {} bytes", bytes));
}

Memory::~Memory() {
  if (memory_ != nullptr) clReleaseMemObject(memory_);
}

Memory::Memory(Memory&& other) noexcept
    : memory_(std::exchange(other.memory_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

Memory& Memory::operator=(Memory&& other) noexcept {
  std::swap(memory_, other.memory_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

void Memory::write(const Queue& queue, const void* source, std::size_t bytes) {
  if (bytes > bytes_)
    throw DeviceError(
        fmt::format("clEnqueueWriteBuffer: {} bytes do not fit into a buffer of {} bytes", bytes, bytes_));
  if (bytes == 0) return;
  check(clEnqueueWriteBuffer(queue.get(), memory_, CL_TRUE, 0, bytes, source, 0, nullptr, nullptr),
        "clEnqueueWriteBuffer");
}

void Memory::read(const Queue& queue, void* target, std::size_t bytes, std::size_t offset) const {
  if (offset > bytes_ || bytes > bytes_ - offset)
    throw DeviceError(
        fmt::format("clEnqueueReadBuffer: {} bytes at offset {} do not fit into a buffer of {} bytes", bytes,
                    offset, bytes_));
  if (bytes == 0) return;
  check(clEnqueueReadBuffer(queue.get(), memory_, CL_TRUE, offset, bytes, target, 0, nullptr, nullptr),
        "clEnqueueReadBuffer");
}

}  // namespace pelage::cl
