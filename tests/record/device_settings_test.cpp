// Tests how rows of one device with several settings get axes.
#include "harness/record/device_settings.hpp"

#include <gtest/gtest.h>

namespace pelage {
namespace {

FoundRow row(const std::string& name, int compute_units, const std::string& identity) {
  FoundRow found;
  found.row.experiment = "e";
  found.row.case_name = name;
  found.row.device = "cpu";
  found.row.axes = {{"layers", name}};
  found.row.identity = {{"device", identity}, {"scene", name}};
  found.row.provenance = {{"host", "h"}, {"compute_units", compute_units}};
  return found;
}

std::string axis(const FoundRow& found, const std::string& key) {
  const auto place = found.row.axes.find(key);
  return place == found.row.axes.end() ? "absent" : place->second;
}

TEST(DeviceSettings, NumbersOfThreadsAreAnAxis) {
  std::vector<FoundRow> rows{row("8", 1, "one"), row("16", 1, "one"), row("8", 2, "two"), row("4", 2, "two")};
  for (const std::size_t i : {0u, 1u})
    rows[i].row.provenance["environment"] = {{"POCL_MAX_PTHREAD_COUNT", "1"}};
  rows.push_back(rows[0]);
  rows.back().row.experiment = "other";
  add_settings_as_axes(rows);
  EXPECT_EQ(axis(rows[0], "compute_units"), "1");
  EXPECT_EQ(axis(rows[1], "compute_units"), "1") << "also cases with one setting";
  EXPECT_EQ(axis(rows[2], "compute_units"), "2");
  EXPECT_EQ(axis(rows[3], "compute_units"), "2");
  EXPECT_EQ(axis(rows[0], "POCL_MAX_PTHREAD_COUNT"), "absent")
      << "compute_units tells the rows apart already";
  EXPECT_EQ(axis(rows[4], "compute_units"), "absent") << "another experiment";
  EXPECT_TRUE(is_device_setting("compute_units"));
  EXPECT_TRUE(is_device_setting("POCL_WORK_GROUP_METHOD"));
  EXPECT_FALSE(is_device_setting("layers"));
}

TEST(DeviceSettings, AVariableThatIsNotSetHasAValueToo) {
  std::vector<FoundRow> rows{row("8", 2, "one"), row("8", 2, "two"), row("8", 2, "three")};
  rows[1].row.provenance["environment"] = {{"POCL_WORK_GROUP_METHOD", "loops"}};
  rows[2].row.provenance["environment"] = {{"POCL_WORK_GROUP_METHOD", "loops"}};
  rows[2].row.provenance["pocl_affinity"] = "1";
  add_settings_as_axes(rows);
  EXPECT_EQ(axis(rows[0], "POCL_WORK_GROUP_METHOD"), "unset");
  EXPECT_EQ(axis(rows[1], "POCL_WORK_GROUP_METHOD"), "loops");
  EXPECT_EQ(axis(rows[1], "pocl_affinity"), "unset");
  EXPECT_EQ(axis(rows[2], "pocl_affinity"), "1");
}

// Rows whose scenes differ too stay as they are: an axis would name only a part of the difference.
TEST(DeviceSettings, OtherDifferencesGiveNoAxis) {
  std::vector<FoundRow> rows{row("8", 1, "one"), row("8", 2, "two"), row("8", 2, "two")};
  rows[2].row.identity["scene"] = "another";
  add_settings_as_axes(rows);
  for (const FoundRow& found : rows) EXPECT_EQ(found.row.axes.size(), 1u);
  std::vector<FoundRow> old{row("8", 1, ""), row("8", 2, "")};
  for (FoundRow& found : old) found.row.identity.clear();  // schema 1
  add_settings_as_axes(old);
  EXPECT_EQ(old[0].row.axes.size(), 1u);
}

}  // namespace
}  // namespace pelage
