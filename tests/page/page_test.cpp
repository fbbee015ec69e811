#include "harness/page/page.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "harness/picture/image_io.hpp"
#include "tests/report/rows.hpp"
#include "tests/support/files.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

using namespace test;

/// Returns the nonce in the Content-Security-Policy of the page, or "" if the policy has none.
std::string nonce_of(const std::string& page) {
  const std::string policy = "script-src 'nonce-";
  const std::size_t at = page.find(policy);
  return at == std::string::npos ? "" : page.substr(at + policy.size(), 32);
}

/// Writes a picture whose pattern is hard to compress, so that its file is large.
void write_pattern(const fs::path& file, int width, int height) {
  Picture picture{width, height, std::vector<glm::vec4>(std::size_t(width) * std::size_t(height))};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture.at(x, y) = {float((x * 7919 + y * 104729) % 251) / 251, float(x % 17) / 17, 0.5f, 1};
  write_picture(file, picture);
}

struct Page : test::InFolder {};

/// HTML code in the results is escaped, both in the page and in the data for its scripts.
TEST_F(Page, HostileNamesAreText) {
  const std::string hostile = "</script><img src=x onerror=alert(1)>\"'<!--";
  std::vector<FoundRow> rows = test::table1_rows();
  rows.resize(2);
  rows[0].row.case_name = rows[0].row.axes["model"] = hostile;
  rows[1].row.status = Status::error;
  rows[1].row.reason = rows[1].row.provenance["cpu"] = hostile;
  for (FoundRow& found : rows) found.row.experiment = hostile, found.row.provenance["title"] = hostile;
  PageParts parts;
  parts.notes = {hostile};
  const std::string page = page_of(write_reports(rows, folder.path, {}), parts);
  test::expect_lacks(page, "<img src=x");
  const std::string number = nonce_of(page);
  EXPECT_EQ(number.size(), 32u);
  EXPECT_EQ(number.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(count_of(page, "<script nonce=\"" + number + "\">"), count_of(page, "</script>") - 1)
      << "one more closes the element with the data";
  EXPECT_EQ(count_of(page, "<script"), count_of(page, "</script>"));
  const std::string other = page_of(write_reports(rows, folder.path / "other", {}), parts);
  EXPECT_EQ(other.find(number), std::string::npos) << "each page has its own nonce";
  EXPECT_GT(count_of(page, "&lt;img src=x onerror"), 3u);

  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t start = page.find(open) + open.size();
  const std::string data = page.substr(start, page.find("</script>", start) - start);
  EXPECT_EQ(data.find('<'), std::string::npos);
  const auto json = nlohmann::json::parse(data);
  EXPECT_EQ(json["rows"][0]["case"], hostile) << "the data are complete";
}

/// The policy forbids network access, and permits only scripts that have the page's nonce.
TEST_F(Page, ThePolicyNamesEveryScript) {
  const std::string page = page_of(write_reports(test::table1_rows(), folder.path, {}), {});
  test::expect_has(page, "default-src 'none'");
  test::expect_lacks(page, "script-src 'unsafe-inline'");
  EXPECT_EQ(count_of(page, "<script nonce=\"" + nonce_of(page) + "\">"), 4u);
  test::expect_lacks(page, {" src=\"http", " href=\"http"});
}

/// The tables of the page refer to every cell by its index, and each cell to its rows.
TEST_F(Page, CellsLeadToRows) {
  std::vector<FoundRow> rows = test::table1_rows();
  std::vector<FoundRow> repeated = rows;
  for (FoundRow& found : repeated) found.row.repeat = 1;
  rows.insert(rows.end(), repeated.begin(), repeated.end());
  const std::vector<Report> reports = write_reports(rows, folder.path, {});
  const auto data = nlohmann::json::parse(data_of(reports));
  ASSERT_EQ(data["parts"].size(), 1u);
  ASSERT_EQ(data["parts"][0]["cells"].size(), 32u);
  ASSERT_EQ(data["rows"].size(), 64u);
  for (const auto& cell : data["parts"][0]["cells"]) {
    ASSERT_EQ(cell["rows"].size(), 2u);
    EXPECT_EQ(data["rows"][cell["rows"][0].get<std::size_t>()]["case"],
              data["rows"][cell["rows"][1].get<std::size_t>()]["case"]);
  }
  const std::string body = body_of(reports, {});
  for (int cell = 0; cell < 32; ++cell)
    EXPECT_NE(body.find(fmt::format("data-cell=\"{}\"", cell)), std::string::npos) << cell;
  EXPECT_EQ(count_of(body, "<tr data-row="), 64u);
  EXPECT_FALSE(data["parts"][0]["files"]["silva2010-table1.csv"].get<std::string>().empty());
}

/// The summary names cases without times only if there are such cases.
TEST_F(Page, TheSummaryCountsTheCasesWithoutTimes) {
  std::vector<FoundRow> rows = test::table1_rows();
  const std::string all = page_of(write_reports(rows, folder.path, {}), {});
  test::expect_has(all, "32 cases. All of them are ok");
  test::expect_lacks(all, "have no times");
  rows[0].row.status = Status::error;
  test::expect_has(page_of(write_reports(rows, folder.path, {}), {}),
                   {"32 cases. 31 of them are ok", "The other case has no time."});
}

/// Rows of the same cases that were measured with another mesh are a second set of results on one page.
TEST_F(Page, OnePageHasAllSets) {
  std::vector<FoundRow> rows = test::table1_rows(), others = test::table1_rows(2);
  for (FoundRow& found : others) {
    found.journal = "other.jsonl";
    found.row.run_id = "other";
    found.row.identity = {{"mesh", "0123456789abcdef"}};
  }
  rows.insert(rows.end(), others.begin(), others.end());
  const std::vector<Report> reports = write_reports(rows, folder.path, {});
  ASSERT_EQ(reports.size(), 2u);
  test::expect_has(reports[0].notes.at(0), {"32 of 64 rows", " inputs-2,"});
  EXPECT_NE(reports[0].sections.back().table.stem, "left-out") << "nothing is left out";
  write_page(reports, folder.path / "index.html");
  const std::string page = folder.read("index.html");
  test::expect_has(page, "Results, set 2");
  EXPECT_EQ(count_of(page, "<tr data-row="), 64u);
  EXPECT_FALSE(fs::exists(folder.path / "inputs-2/index.html"));
  EXPECT_TRUE(fs::exists(folder.path / "inputs-2/tables/all-phases.csv"));
}

/// A plot is a part of the page. Its points have texts with their values, which a browser shows as tooltips.
TEST_F(Page, PlotsHaveTheirValues) {
  const std::vector<Report> reports = write_reports(test::table1_rows(), folder.path, {});
  if (reports[0].plots.empty()) GTEST_SKIP() << "matplotlib is not installed";
  const std::string body = body_of(reports, {});
  EXPECT_EQ(count_of(body, "<figure class=\"plot\">"), reports[0].plots.size());
  test::expect_has(body, "data-file=\"silva2010-table1.csv\">CSV of the plot");
  EXPECT_EQ(count_of(body, "<?xml"), 0u);
  EXPECT_EQ(count_of(body, "<metadata"), 0u);
  // 32 cases, with our number and the paper's.
  EXPECT_EQ(count_of(body, "</title></use>"), 64u);
}

/// page_pictures() reduces the width of the pictures until their total size is within the limit, and leaves
/// pictures out only if it is too large even at the smallest width.
TEST_F(Page, PicturesAreReducedToTheLimit) {
  std::vector<FoundRow> rows = test::table1_rows();
  const fs::path journal = folder.path / "results" / "silva2010-table1" / "test_device@h.jsonl";
  fs::create_directories(journal.parent_path() / "images");
  for (FoundRow& found : rows) found.journal = journal;
  for (const char* name : {"torus-64-800x600", "cow-64-800x600", "lion-16-800x600"})
    write_pattern(journal.parent_path() / "images" / (std::string(name) + ".png"), 640, 400);
  std::ofstream(journal.parent_path() / "images" / "pear-64-800x600.png") << "not a picture";
  const std::vector<Report> reports = write_reports(rows, folder.path / "report", {});

  std::vector<std::string> notes;
  const auto pictures = page_pictures(reports, {.bytes = 1'000'000, .most_width = 500}, notes);
  ASSERT_EQ(pictures.size(), 3u);
  EXPECT_EQ(pictures[0].width, 500);
  EXPECT_EQ(pictures[0].webp.substr(0, 4), "RIFF");
  ASSERT_EQ(notes.size(), 1u);
  test::expect_has(notes[0], "pear-64-800x600.png");

  notes.clear();
  const auto small = page_pictures(reports, {.bytes = 30'000, .most_width = 500, .least_width = 40}, notes);
  ASSERT_EQ(small.size(), 3u);
  EXPECT_LT(small[0].width, 500);
  std::size_t bytes = 0;
  for (const PagePicture& picture : small) bytes += picture.webp.size();
  EXPECT_LE(bytes, 30'000u);

  notes.clear();
  EXPECT_LT(page_pictures(reports, {.bytes = 500, .most_width = 500, .least_width = 200}, notes).size(), 3u);
  test::expect_has(notes.back(), "of 3 pictures");

  PageParts parts;
  parts.pictures = pictures;
  const std::string body = body_of(reports, parts);
  EXPECT_EQ(count_of(body, "src=\"data:image/webp;base64,"), 3u);
}

TEST_F(Page, APlaceThatCannotBeWritten) {
  EXPECT_THROW(write_page({}, folder.path / "none" / "index.html"), InputError);
}

}  // namespace
}  // namespace pelage
