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
/// Maps the path of a kernel file, relative to the kernel folder, to the file's contents.
using SourceTexts = std::map<std::string, std::string>;

/// Returns the contents of `file` and of every file that it includes, directly or indirectly. Throws
/// InputError if a file is missing.
SourceTexts source_texts(const std::filesystem::path& file);
Sources hashes_of(const SourceTexts& texts);
/// Returns the hashes of source_texts(file).
Sources sources_of(const std::filesystem::path& file);

/// Returns 16 hex digits: the FNV-1a hash of the paths and contents of the files.
std::string hash_of(const Sources& sources);

/// Returns the options without each "-D NAME" and "-D NAME=VALUE" whose NAME no source reads. Such an option
/// changes nothing in the program, but drivers would compile the program again for each value.
std::string options_read(const std::string& options, const SourceTexts& sources);

/// What identifies a program: its file in the kernel folder and its build options.
struct ProgramText {
  std::string file, options;
  bool operator==(const ProgramText&) const = default;
};

/// A program after its build.
struct BuiltProgram {
  Owned<cl_program, clReleaseProgram> program;
  ProgramText text;  ///< with the options that the sources read
  std::string log;
  Sources sources;
  double build_ms = 0;
  bool by_pocl = false;
};

/// Returns a text that differs for two programs if their sources, their kernel folders or the options that
/// the sources read differ. Throws InputError if a source file is missing.
std::string build_key(const ProgramText& text);

/// Returns the program kernels/<text.file>, built with the options -I kernels and those of `text.options`
/// that the sources read (options_read()). Builds it unless the process has built it for this device before;
/// if another thread is building it, waits for this thread. If the build fails, throws DeviceError with the
/// build log and the options. Several threads may call this function; the builds run one at a time.
std::shared_ptr<const BuiltProgram> build_program(const Device& device, const ProgramText& text);

class Program {
 public:
  Program(const Device& device, const ProgramText& text);
  Program(const Device& device, const std::string& file, const std::string& options = {})
      : Program(device, ProgramText{file, options}) {}
  Program(Program&&) noexcept = default;
  Program& operator=(Program&&) noexcept = default;
  cl_program get() const { return built_->program.get(); }
  const std::string& log() const { return built_->log; }
  double build_ms() const { return built_->build_ms; }
  const ProgramText& text() const { return built_->text; }  ///< with the options that the sources read
  const std::string& file() const { return text().file; }   ///< path of the file in the kernel folder
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

class Event {
 public:
  Event() = default;
  explicit Event(cl_event event, std::string kernel = {}, std::size_t bytes = 0)
      : event_(event), kernel_(std::move(kernel)), bytes_(bytes) {}
  /// Waits for the end of the command and returns its duration in ms. The result is empty if the device's
  /// timer is unusable (its resolution is 0, or the end of the command is not after its start).
  std::optional<double> milliseconds(const Device& device) const;
  cl_event get() const { return event_.get(); }
  const std::string& kernel() const { return kernel_; }  ///< name of the kernel that was launched
  std::size_t bytes() const { return bytes_; }  ///< sum of the sizes of the kernel's buffer arguments

 private:
  Owned<cl_event, clReleaseEvent> event_;
  std::string kernel_;
  std::size_t bytes_ = 0;
};

/// One pair per kernel launch, in launch order: the name of the phase, for instance "simulate" or "raster",
/// and the event of the launch. Event times can be read only after the queue has finished.
using PhaseEvents = std::vector<std::pair<std::string, Event>>;

/// Appends a launch of the phase to `events`, unless `events` is null.
inline void keep(PhaseEvents* events, const char* phase, Event&& event) {
  if (events) events->emplace_back(phase, std::move(event));
}

class Kernel {
 public:
  Kernel(const Program& program, const std::string& name);

  /// Sets all arguments in order. An argument is a Buffer<T>, a Memory, or a trivially copyable value (a
  /// number or a struct of params.h).
  template <class... A>
  Kernel& with(const A&... values) {
    cl_uint index = 0;
    bytes_ = 0;
    (set(index++, values), ...);
    return *this;
  }
  /// Sets all numbers to 0 and all pointers to `memory`, for a launch that only compiles the kernel. No
  /// kernel may have a number of the size of a cl_mem.
  Kernel& with_zeros(const Memory& memory);
  /// Enqueues the kernel over at least `items` work-items, in work-groups of `group` work-items. The number
  /// of work-items is rounded up to a multiple of the group size, so the kernel must ignore the work-items
  /// from `items` on. If `group` is 0, the size is the one that the kernel requires (reqd_work_group_size),
  /// or else usual_group(). If the device cannot run the kernel in groups of this size, the size is halved
  /// until it can.
  ///
  /// The driver never selects the size: PoCL compiles a kernel again for each size, and the drivers' sizes
  /// are divisors of `items`, which depends on the mesh.
  Event enqueue(const Queue& queue, std::size_t items, std::size_t group = 0) const;
  Event enqueue(const Queue& queue, std::array<std::size_t, 2> items, std::array<std::size_t, 2> group) const;
  /// Enqueues a kernel that loops over `count` elements with the step get_global_size(0). A work-item
  /// processes one element on a GPU and many on a CPU, because PoCL copies the parameters for every
  /// work-item.
  Event enqueue_loop(const Queue& queue, std::size_t count) const;

 private:
  /// The sizes of work-groups that a device permits for the kernel.
  struct Groups {
    std::size_t required = 0;  ///< the size that the kernel requires; 0: none
    std::size_t most = 0;      ///< CL_KERNEL_WORK_GROUP_SIZE; 0: not yet known
  };
  const Groups& groups(const Queue& queue) const;
  Event launch(const Queue& queue, unsigned dimensions, std::array<std::size_t, 2> items,
               std::array<std::size_t, 2> group) const;

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

  Owned<cl_kernel, clReleaseKernel> kernel_;
  std::string name_;
  std::size_t bytes_ = 0;
  mutable Groups groups_;
};

/// Copies a vector into an array of a struct that the host passes to kernels.
template <class V, std::size_t N>
void copy(float (&to)[N], const V& from) {
  for (std::size_t i = 0; i < N; ++i) to[i] = from[int(i)];
}

// The names of two ways to draw a picture on a device. Shells and strands have both.
inline constexpr std::string_view tile_mapping = "tile";    ///< a work-item draws a tile, for CPUs
inline constexpr std::string_view group_mapping = "group";  ///< a work-group draws a tile, for GPUs

/// Returns the exponent if it is an integer from 1 to 1024, for which kernels multiply, else 0.
int whole_exponent(float exponent);

/// Returns `wanted`, or the device's number of lanes if `wanted` is 0. Throws InputError unless `wanted` is
/// 0, 1 or 16.
int lanes_of(const DeviceInfo& device, int wanted);

/// Returns the number of units per work-item. A unit is `lanes` sticks, strands or triangles, which a
/// work-item computes at a time, and `units` is their number. On a CPU the units are divided among about 8
/// work-items per core, with at most 64 units per work-item; on a GPU a work-item computes one unit.
/// `wanted`: number of slices of 16 per work-item; 0: the device's default.
int units_per_item(const DeviceInfo& device, int lanes, int units, int wanted);

/// The usual number of work-items of a work-group: 1 where a work-item computes several lanes, so that few
/// work-items are distributed evenly over the cores, and 64 on other devices.
std::size_t usual_group(const DeviceInfo& device);

}  // namespace pelage::cl
