#include "harness/cl/buffer.hpp"

#include <fmt/format.h>

#include "harness/error.hpp"

namespace pelage::cl {

Queue::Queue(const Device& device) : device_(device) {
  cl_int code = CL_SUCCESS;
  queue_.reset(clCreateCommandQueue(device.context(), device.id(), CL_QUEUE_PROFILING_ENABLE, &code));
  check(code, "clCreateCommandQueue");
}

void Queue::finish() const {
  check(clFinish(queue_.get()), "clFinish");
}

Memory::Memory(const Device& device, std::size_t bytes) : bytes_(bytes) {
  // Drivers allocate lazily. Without this test, a kernel launch would fail later, with an error that does not
  // name the size.
  if (bytes > device.info().max_allocation)
    throw DeviceError(fmt::format(
        "clCreateBuffer: {} MB requested, but {} allocates at most {} MB at once: try a smaller picture or mesh, fewer layers or another --device",
        bytes >> 20, device.info().name, device.info().max_allocation >> 20));
  cl_int code = CL_SUCCESS;
  memory_.reset(clCreateBuffer(device.context(), CL_MEM_READ_WRITE, bytes > 0 ? bytes : 1, nullptr, &code));
  check(code, fmt::format("clCreateBuffer of {} bytes", bytes));
}

void Memory::write(const Queue& queue, const void* source, std::size_t bytes) {
  if (bytes > bytes_)
    throw DeviceError(
        fmt::format("clEnqueueWriteBuffer: {} bytes do not fit into a buffer of {} bytes", bytes, bytes_));
  if (bytes == 0) return;
  check(clEnqueueWriteBuffer(queue.get(), memory_.get(), CL_TRUE, 0, bytes, source, 0, nullptr, nullptr),
        "clEnqueueWriteBuffer");
}

void Memory::read(const Queue& queue, void* target, std::size_t bytes, std::size_t offset) const {
  if (offset > bytes_ || bytes > bytes_ - offset)
    throw DeviceError(
        fmt::format("clEnqueueReadBuffer: {} bytes at offset {} do not fit into a buffer of {} bytes", bytes,
                    offset, bytes_));
  if (bytes == 0) return;
  check(clEnqueueReadBuffer(queue.get(), memory_.get(), CL_TRUE, offset, bytes, target, 0, nullptr, nullptr),
        "clEnqueueReadBuffer");
}

}  // namespace pelage::cl
