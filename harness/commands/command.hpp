// How a command of pelage is written. One file per command: it declares its options on `app`, and when the
// command line names it, puts into `chosen` the function that main() then runs. That function returns the
// exit code (0 done, 1 a check failed, 5 regression) or throws: InputError becomes exit 2, NoDeviceError 3,
// anything else 1. Data goes to stdout, messages to stderr.
//
//   void add_devices(CLI::App& app, Chosen& chosen) {
//     auto options = std::make_shared<DevicesOptions>();          // lives as long as the callbacks that hold
//     it CLI::App* command = app.add_subcommand("devices", "List every platform and device");
//     command->add_flag("--json", options->json, "Print JSON");
//     command->callback([options, &chosen] { chosen = [options] { return list_devices(*options); }; });
//   }
//
// A command is added to main.cpp's list only once it works.
#pragma once
#include <CLI/CLI.hpp>
#include <functional>

namespace pelage {

using Chosen = std::function<int()>;

}  // namespace pelage
