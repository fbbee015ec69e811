// The command line of pelage. After a failure, the program prints a message on stderr. The exit codes are: 0
// success; 1 failed check or other error; 2 bad usage or input; 3 no usable device; 4 missing shards or cases
// (command merge); 5 regression; 130 or 143 interrupted by a signal.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <string>
#include <string_view>

#include "harness/cl/compile.hpp"
#include "harness/commands/commands.hpp"
#include "harness/error.hpp"
#include "harness/version/version.hpp"

namespace {

using namespace pelage;

std::string version() {
  const BuildInfo& build = build_info();
  return fmt::format(
      "pelage {} ({}{}, {})\n"
      "GPL-3.0-or-later\n"
      "To cite it, name the version and the revision: \"pelage: an OpenCL research benchmark harness for real-time fur and grass, version {}, revision {}\";\nCITATION.cff contains this citation for reference managers. Also cite the papers whose systems you timed; the report's references.bib lists them.",
      build.version, build.revision, build.dirty ? ", modified" : "", build.compiler, build.version,
      build.revision.substr(0, 12));
}

int failed(const std::string& what, int code) {
  // Names of files may contain control characters, which a terminal would execute as commands.
  std::string line;
  for (const char c : what) {
    if (c == '\n' || c == '\t')
      line += ' ';
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      line += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      line += c;
  }
  fmt::print(stderr, "pelage: {}\n", line);
  return code;
}

int run(const Chosen& command) {
  const int code = command();
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) return failed("standard output cannot be written", 2);
  return code;
}

/// If SIGHUP is ignored, as nohup asks, blocks it too: the compiler of an OpenCL driver installs handlers for
/// it, and a hangup would then end the build of a kernel.
void keep_ignoring_hangups() {
  struct sigaction now = {};
  if (sigaction(SIGHUP, nullptr, &now) != 0 || now.sa_handler != SIG_IGN) return;
  sigset_t hangup;
  sigemptyset(&hangup);
  sigaddset(&hangup, SIGHUP);
  sigprocmask(SIG_BLOCK, &hangup, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  keep_ignoring_hangups();
  // Each line of stdout is written at once, also into a pipe. In `pelage report ... 2>&1 | less`, a message
  // on stderr therefore never interrupts a line of stdout.
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  if (argc > 1 && argv[1] == cl::compile_word)
    return cl::compile_kernels({argv + 2, static_cast<std::size_t>(argc - 2)});
  cl::allow_processes();
  CLI::App app("Times real-time fur and grass on OpenCL devices: shells, wet fur, strands and mass-springs",
               "pelage");
  app.set_version_flag("--version", version, "Print the version and how to cite it");
  std::string kernels;
  app.add_option("--kernels", kernels, "Folder of OpenCL kernels to use instead of pelage's own")
      ->type_name("DIR");
  app.fallthrough();
  Chosen chosen;
  for (AddCommand* add :
       {add_devices,  add_scene,  add_render,  add_animate, add_diagram, add_groom,     add_mesh,
        add_topology, add_water,  add_check,   add_tune,    add_profile, add_list,      add_run,
        add_merge,    add_export, add_compare, add_report,  add_claims,  add_reproduce, add_manual})
    add(app, chosen);
  app.require_subcommand(0, 1);

  try {
    const std::string_view word = argc > 1 ? argv[1] : "";
    if (word == "aa-test") throw InputError("aa-test is a script now: scripts/aa_test.py of the source tree");
    if (word == "completion") throw InputError("completion is gone; remove it from the shell's start file");
    if (word == "roofline") throw InputError("roofline is now: pelage profile, which counts no operations");
    app.parse(argc, argv);
    if (!kernels.empty()) cl::set_kernel_folder(kernels);
    if (!chosen) throw InputError("give a command; `pelage --help` lists them");
    return run(chosen);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return failed(fmt::format("{}; `pelage --help` and `pelage COMMAND --help` show the usage", error.what()),
                  2);
  } catch (const InputError& error) {
    return failed(error.what(), 2);
  } catch (const std::filesystem::filesystem_error& error) {
    return failed(fmt::format("{}: {}", error.path1().string(), error.code().message()), 2);
  } catch (const NoDeviceError& error) {
    return failed(error.what(), 3);
  } catch (const DeviceError& error) {
    // failed() would replace newlines by spaces. The text may contain the build log of a kernel, which needs
    // its newlines.
    fmt::print(stderr, "pelage: {}\n", error.what());
    return 1;
  } catch (const std::bad_alloc&) {
    return failed("out of memory", 1);
  } catch (const std::exception& error) {
    if (std::ferror(stdout)) return failed("standard output cannot be written", 2);
    return failed(error.what(), 1);
  }
}
