// Classes for device memory and command queues. Objects can be moved but not copied.
#pragma once
#include <span>

#include "harness/cl/device.hpp"

namespace pelage::cl {

/// Returns the name of an OpenCL error code, as in CL/cl.h.
std::string error_name(cl_int code);

/// Throws DeviceError if `code` is an error. The message names the OpenCL call and the error, and says what
/// the user can do.
void check(cl_int code, std::string_view call);

class Queue {
 public:
  explicit Queue(const Device& device);  ///< creates an in-order queue with profiling
  cl_command_queue get() const { return queue_.get(); }
  const Device& device() const { return device_; }
  void finish() const;

 private:
  Device device_;
  Owned<cl_command_queue, clReleaseCommandQueue> queue_;
};

/// A block of device memory without an element type. Buffer<T> stores its values in such a block.
class Memory {
 public:
  Memory() = default;
  Memory(const Device& device, std::size_t bytes);  ///< allocates `bytes` bytes, at least one
  cl_mem get() const { return memory_.get(); }
  std::size_t bytes() const { return bytes_; }
  void write(const Queue& queue, const void* source, std::size_t bytes);                         ///< blocking
  void read(const Queue& queue, void* target, std::size_t bytes, std::size_t offset = 0) const;  ///< blocking

 private:
  Owned<cl_mem, clReleaseMemObject> memory_;
  std::size_t bytes_ = 0;
};

/// Device memory for `count` values of type T.
template <class T>
class Buffer {
 public:
  Buffer() = default;
  Buffer(const Device& device, std::size_t count) : memory_(device, count * sizeof(T)), count_(count) {}
  Buffer(const Queue& queue, std::span<const T> values) : Buffer(queue.device(), values.size()) {
    write(queue, values);
  }
  std::size_t size() const { return count_; }
  cl_mem get() const { return memory_.get(); }
  void write(const Queue& queue, std::span<const T> values) {
    memory_.write(queue, values.data(), values.size_bytes());
  }
  void read(const Queue& queue, std::span<T> values, std::size_t first = 0) const {
    memory_.read(queue, values.data(), values.size_bytes(), first * sizeof(T));
  }
  std::vector<T> read(const Queue& queue) const {
    std::vector<T> values(count_);
    read(queue, values);
    return values;
  }

 private:
  Memory memory_;
  std::size_t count_ = 0;
};

/// Returns a new buffer with a copy of the values.
template <class T>
Buffer<T> uploaded(const Queue& queue, const std::vector<T>& values) {
  return {queue, values};
}

}  // namespace pelage::cl
