// Classes for OpenCL programs, kernels and events. A program is built from files in kernels/. A kernel has
// typed arguments. An event reports the time of a launch.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "harness/cl/buffer.hpp"

namespace pelage::cl {

/// Returns the folder of kernel sources. This is the folder that the option --kernels or set_kernel_folder()
/// names. If neither was used, it is $PELAGE_DATA/kernels. If PELAGE_DATA is not set either, it is kernels/
/// in the last folder of data_folders() (harness/data_folder.hpp). Throws InputError if this folder does not
/// exist.
std::filesystem::path kernel_folder();
void set_kernel_folder(const std::filesystem::path& folder);

/// Maps the path of a kernel file, relative to the kernel folder, to the hash of the file's contents.
using Sources = std::map<std::string, std::uint64_t>;

/// Returns the hashes of `file` and of every file that it includes, directly or indirectly. Throws InputError
/// if a file is missing.
Sources sources_of(const std::filesystem::path& file);

/// Returns 16 hex digits: the FNV-1a hash of the paths and contents of the files.
std::string hash_of(const Sources& sources);

/// What identifies a program: its file in the kernel folder and its build options.
struct ProgramText {
  std::string file, options;
  bool operator==(const ProgramText&) const = default;
};

/// A program after its build.
struct BuiltProgram {
  BuiltProgram() = default;
  ~BuiltProgram();
  BuiltProgram(const BuiltProgram&) = delete;
  BuiltProgram& operator=(const BuiltProgram&) = delete;
  cl_program program = nullptr;
  std::string file, log;
  Sources sources;
  double build_ms = 0;
  bool by_pocl = false;
};

/// Builds kernels/<text.file> with the options -I kernels and `text.options`. If the build fails, throws
/// DeviceError with the build log and the options. Several threads may call this function; the builds run one
/// at a time.
std::shared_ptr<const BuiltProgram> build_program(const Device& device, const ProgramText& text);

class Program {
 public:
  /// Builds the program like build_program(), unless a BuildAhead (build_ahead.hpp) has built it or is about
  /// to. In this case, the constructor waits for that build.
  Program(const Device& device, const ProgramText& text);
  Program(const Device& device, const std::string& file, const std::string& options = {})
      : Program(device, ProgramText{file, options}) {}
  Program(Program&&) noexcept = default;
  Program& operator=(Program&&) noexcept = default;
  cl_program get() const { return built_->program; }
  const std::string& log() const { return built_->log; }
  double build_ms() const { return built_->build_ms; }
  const std::string& file() const { return built_->file; }  ///< path of the file in the kernel folder
  const Sources& sources() const { return built_->sources; }
  /// Text to append to the error message if the driver does not find a kernel. PoCL does not find a kernel if
  /// a file in its folder of compiled kernels is damaged; the text advises the user to delete this folder.
  /// The text is empty for other drivers.
  std::string cache_advice() const;

 private:
  std::shared_ptr<const BuiltProgram> built_;
};

/// Returns 16 hex digits: the hash of the source files of all programs in `programs`.
std::string hash_of(const std::vector<const Program*>& programs);

/// Returns a map from each program's file to the hash of the program's source files, as they were when the
/// program was built.
std::map<std::string, std::string> hashes_by_file(const std::vector<const Program*>& programs);

class Event {
 public:
  Event() = default;
  explicit Event(cl_event event, std::string kernel = {}, std::size_t bytes = 0)
      : event_(event), kernel_(std::move(kernel)), bytes_(bytes) {}
  ~Event();
  Event(Event&& other) noexcept;
  Event& operator=(Event&& other) noexcept;
  /// Waits for the end of the command and returns its duration in ms. The result is empty if the device's
  /// timer is unusable (its resolution is 0, or the end of the command is not after its start).
  std::optional<double> milliseconds(const Device& device) const;
  cl_event get() const { return event_; }
  const std::string& kernel() const { return kernel_; }  ///< name of the kernel that was launched
  std::size_t bytes() const { return bytes_; }  ///< sum of the sizes of the kernel's buffer arguments

 private:
  cl_event event_ = nullptr;
  std::string kernel_;
  std::size_t bytes_ = 0;
};

class Kernel {
 public:
  Kernel(const Program& program, const std::string& name);
  ~Kernel();
  Kernel(Kernel&& other) noexcept;
  Kernel& operator=(Kernel&& other) noexcept;

  /// Sets all arguments in order. An argument is a Buffer<T>, a Memory, or a trivially copyable value (a
  /// number or a struct of params.h).
  template <class... A>
  Kernel& with(const A&... values) {
    cl_uint index = 0;
    bytes_ = 0;
    (set(index++, values), ...);
    return *this;
  }
  /// Enqueues the kernel over `global` work-items. If `local` is 0, the driver selects the work-group size.
  Event enqueue(const Queue& queue, std::array<std::size_t, 2> global,
                std::array<std::size_t, 2> local = {0, 0}) const;
  Event enqueue(const Queue& queue, std::size_t global, std::size_t local = 0) const;

 private:
  template <class T>
  void set(cl_uint index, const Buffer<T>& buffer) {
    set_memory(index, buffer.get());
    bytes_ += buffer.size() * sizeof(T);
  }
  void set(cl_uint index, const Memory& memory) {
    set_memory(index, memory.get());
    bytes_ += memory.bytes();
  }
  template <class T>
  requires(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T> &&
           !std::is_same_v<T, bool>) void set(cl_uint index, const T& value) {
    set_bytes(index, sizeof(T), &value);
  }
  void set_memory(cl_uint index, cl_mem memory);
  void set_bytes(cl_uint index, std::size_t bytes, const void* value);

  cl_kernel kernel_ = nullptr;
  std::string name_;
  std::size_t bytes_ = 0;
};

}  // namespace pelage::cl
