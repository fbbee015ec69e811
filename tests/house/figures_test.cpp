// Tests that the measured figures in the documents are those of the recorded results.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

TEST(Figures, OfTheDocumentsAreThoseOfTheRecordedResults) {
  EXPECT_EQ(std::system("python3 '" PELAGE_SOURCE_DIR "/scripts/figures.py' --check"), 0);
}

// The check finds a wrong number, and a sentence that is missing.
TEST(Figures, PlantedMistakesAreFound) {
  const auto faults = [](const std::string& text) {
    const std::string program = "import sys; sys.path.insert(0, '" PELAGE_SOURCE_DIR
                                "/scripts'); import figures; "
                                "sys.exit(len(figures.checked('" +
                                text +
                                "', 'takes {least} to {most} ms (in {some_cell}).', dict(least='1.5', "
                                "most='20', some_cell='a, b'))[1]))";
    return std::system(("python3 -c \"" + program + "\"").c_str()) >> 8;
  };
  EXPECT_EQ(faults("It takes 1.5 to\\n20 ms (in a,\\nb)."), 0);
  EXPECT_EQ(faults("It takes 1.6 to 20 ms (in a, b)."), 1);
  EXPECT_EQ(faults("It takes 1.6 to 21 ms (in a, b)."), 2);
  EXPECT_EQ(faults("It takes 1.5 to 20 ms (in a, c)."), 1);
  EXPECT_EQ(faults("It takes long."), 1);
  EXPECT_EQ(faults("It takes 1.5 to 20 ms (in a, b). It takes 1.5 to 20 ms (in a, b)."), 1);
}
