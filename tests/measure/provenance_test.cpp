#include "harness/measure/provenance.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace pelage {
namespace {

/// Returns what the shell command prints.
std::string printed(const char* command) {
  std::FILE* pipe = popen(command, "r");
  std::string text;
  std::array<char, 256> part{};
  while (pipe && std::fgets(part.data(), part.size(), pipe)) text += part.data();
  if (pipe) pclose(pipe);
  return text;
}

TEST(Provenance, NamesTheHostAndItsSystem) {
  const nlohmann::ordered_json json = host_provenance({"pelage", "run", "a/b.toml", "--set=x=a/b"}, false);
  EXPECT_EQ(json.at("host").get<std::string>() + "\n", printed("uname -n | cut -d. -f1"));
  EXPECT_EQ(json.at("os"),
            printed("test ! -e /etc/os-release || . /etc/os-release; printf %s \"$PRETTY_NAME\""));
  EXPECT_EQ(json.at("os_kernel").get<std::string>() + "\n", printed("uname -sr"));
  EXPECT_EQ(json.at("cpu"), printed("sed -n '/^model name/{s/^[^:]*: //p;q}' /proc/cpuinfo | tr -d '\\n'"));
  EXPECT_EQ(json.at("argv").at(2), "a/b.toml");
  const std::string mhz = printed("awk '/^cpu MHz/ {s += $4; n++} END {print n ? s / n : -1}' /proc/cpuinfo");
  EXPECT_NEAR(std::log(cpu_mhz() / std::stod(mhz)), 0, 1) << "frequencies change, but not by a factor of e";
  EXPECT_EQ(utc_stamp().substr(0, 8), printed("date -u +%Y%m%d").substr(0, 8));
}

TEST(Provenance, CanBeAnonymous) {
  const nlohmann::ordered_json json = host_provenance({"/a/pelage", "a/b.toml", "--set=x=a/b", "c"}, true);
  EXPECT_EQ(json.at("host"), "anonymous");
  EXPECT_EQ(json.at("argv"), (std::vector<std::string>{"pelage", "b.toml", "--set=x=a/b", "c"}));
}

// POCL_AFFINITY and the other variables of PoCL change the times of CPU devices only.
TEST(Provenance, NamesVariablesOfPoclForCpus) {
  setenv("POCL_AFFINITY", "1", 1);
  setenv("POCL_MAX_PTHREAD_COUNT", "3", 1);
  cl::DeviceInfo info;
  for (const bool cpu : {true, false}) {
    info.cpu = cpu;
    info.timer_resolution_ns = cpu;
    const nlohmann::ordered_json json = device_provenance(info);
    EXPECT_EQ(json.value("pocl_affinity", ""), cpu ? "1" : "");
    EXPECT_EQ(json.contains("environment"), cpu);
    EXPECT_EQ(json.at("timer"), cpu ? "OpenCL events and the wall clock" : "the wall clock");
    if (cpu) {
      EXPECT_EQ(json.at("environment").value("POCL_MAX_PTHREAD_COUNT", ""), "3");
    }
  }
  unsetenv("POCL_AFFINITY");
  unsetenv("POCL_MAX_PTHREAD_COUNT");
  info.cpu = true;
  EXPECT_FALSE(device_provenance(info).contains("pocl_affinity"));
}

TEST(Provenance, AFileNameHasOnlyPlainCharacters) {
  EXPECT_EQ(file_name_of("a-B_9.c d/e"), "a-B_9.c_d_e");
  EXPECT_EQ(file_name_of(".a"), "_.a");
  EXPECT_EQ(file_name_of(""), "_");
}

}  // namespace
}  // namespace pelage
