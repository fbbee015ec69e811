#include "harness/table/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "harness/base/numbers.hpp"
#include "harness/table/render.hpp"
#include "tests/support/texts.hpp"

namespace pelage {
namespace {

/// Returns a table with one line for each combination of two models, two numbers of layers and two picture
/// sizes. The values in the column `ms` are 1 to 8.
Table cases() {
  Table table;
  table.title = "Title";
  table.subtitle = "experiment on <device> & 100%";
  table.columns = {
      {"model", "model"}, {"layers", "layers", "{} layers"}, {"size", "size"}, {"ms", "frame, ms"}};
  table.layout = {{"layers"}, {"model"}, {"size"}, {"ms"}};
  int i = 0;
  for (const char* model : {"torus", "cow"})
    for (const char* layers : {"16", "64"})
      for (const char* size : {"1680x1050", "800x600"})
        table.lines.push_back({text_value(model), text_value(layers), text_value(size), number_value(++i)});
  table.remarks = {"A remark."};
  table.footnotes = {{"a", "cow: a <stand-in> & more"}};
  for (auto& line : table.lines)
    if (line[0].data == "cow") line[0].mark = "a";
  return table;
}

TEST(Table, OrdersValuesAsReadersDo) {
  std::vector<std::string> values{"k10", "1680x1050", "0.5",  "",    "k2", "800x600",
                                  "16",  "b",         "0.05", "k2x", "1e3"};
  std::sort(values.begin(), values.end(), natural_less);
  EXPECT_EQ(values, (std::vector<std::string>{"0.05", "0.5", "16", "1e3", "800x600", "1680x1050", "", "b",
                                              "k2", "k2x", "k10"}));
  EXPECT_EQ(number_of("800x600"), 480000);
  for (const char* text : {"", "x", "800x", "x600", "nan", "inf", "1 2", "0x10y"})
    EXPECT_FALSE(number_of(text)) << text;
}

TEST(Table, RoundsNumbersToThreeDigits) {
  for (const auto& [number, text] : {std::pair(0.8421, "0.842"),
                                     {12.34, "12.3"},
                                     {267.4, "267"},
                                     {123456.0, "123456"},
                                     {0.001234, "0.00123"},
                                     {1e-9, "1e-09"},
                                     {-12.34, "-12.3"},
                                     {0.0, "0"}})
    EXPECT_EQ(three_digits(number), text);
  EXPECT_EQ(number_value({}).shown, "-");
  EXPECT_EQ(number_value({}).data, "");
}

TEST(Pivot, ArrangesTheLines) {
  const Pivot pivot = pivot_of(cases());
  ASSERT_EQ(pivot.blocks.size(), 2u);
  EXPECT_EQ(pivot.blocks[0].label, std::vector<std::string>{"16 layers"});
  ASSERT_EQ(pivot.groups.size(), 2u);
  EXPECT_EQ(pivot.groups[0], std::vector<std::string>{"800x600"});
  ASSERT_EQ(pivot.blocks[1].rows.size(), 2u);
  EXPECT_EQ(pivot.blocks[1].rows[0].keys[0].data, "torus");
  EXPECT_EQ(pivot.blocks[1].rows[0].cells[0]->data, "4");
  EXPECT_EQ(pivot.blocks[1].rows[0].cells[1]->data, "3");
}

/// The cross table shows every line once for any layout, even if several lines have the same keys.
TEST(Pivot, ShowsEveryLine) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    Table table;
    table.columns = {{"a", "a"}, {"b", "b"}, {"c", "c"}, {"value", "value"}};
    const int lines = int(random() % 12);
    for (int i = 0; i < lines; ++i)
      table.lines.push_back({text_value(std::to_string(random() % 3)),
                             text_value(std::to_string(random() % 2)),
                             text_value(std::to_string(random() % 2)), text_value(fmt::format("v{}", i))});
    std::vector<std::string>* places[] = {&table.layout.blocks, &table.layout.rows, &table.layout.groups};
    for (const char* key : {"a", "b", "c"})
      if (const auto place = random() % 4; place < 3) places[place]->push_back(key);
    table.layout.values = {"value"};
    for (const std::string& text : {text_of(table), latex_of(table), html_of(table)}) {
      std::vector<std::string> words;
      for (std::size_t at = text.find('v'); at != std::string::npos; at = text.find('v', at + 1)) {
        std::size_t end = at + 1;
        while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
        words.push_back(text.substr(at, end - at));
      }
      for (int i = 0; i < lines; ++i)
        EXPECT_EQ(std::count(words.begin(), words.end(), fmt::format("v{}", i)), 1) << text;
    }
  }
}

TEST(Formats, AsText) {
  Table answered = cases();
  answered.answer = "A result.";
  EXPECT_EQ(test::lines_of(text_of(answered))[1], "A result.");
  test::expect_lacks(latex_of(answered), "A result.");
  const std::string text = text_of(cases());
  const auto lines = test::lines_of(text);
  ASSERT_EQ(lines.size(), 12u) << text;
  EXPECT_EQ(lines[0], "Title: experiment on <device> & 100%");
  EXPECT_EQ(lines[2], "16 layers   800x600   1680x1050") << text;
  EXPECT_EQ(lines[3], "torus          2.00        1.00") << text;
  EXPECT_EQ(lines[4], "cow a          6.00        5.00") << text;
  EXPECT_EQ(lines[6], "64 layers   800x600   1680x1050") << text;
  EXPECT_EQ(lines[10], "A remark.");
  EXPECT_EQ(lines[11], "a cow: a <stand-in> & more");
}

TEST(Formats, AsCsv) {
  EXPECT_EQ(csv_line({"a", "b,c", "d\"e", "f\ng"}), "a,\"b,c\",\"d\"\"e\",\"f\ng\"\n");
  // An apostrophe prevents a spreadsheet from taking a text for a formula. Numbers get no apostrophe.
  EXPECT_EQ(csv_line({"=1+1", "@x", "-a", "-1.5e-3", "+2", "-"}), "'=1+1,'@x,'-a,-1.5e-3,+2,'-\n");
  const auto lines = test::lines_of(csv_of(cases()));
  ASSERT_EQ(lines.size(), 9u);
  EXPECT_EQ(lines[0], "model,layers,size,ms");
  EXPECT_EQ(lines[1], "torus,16,1680x1050,1");
}

TEST(Formats, AsLatex) {
  const std::string tex = latex_of(cases());
  test::expect_has(
      tex, {"\\begin{adjustbox}{max width=\\columnwidth}", "\\end{adjustbox}", "\\toprule", "\\midrule",
            "\\bottomrule", "$800 \\times 600$", "cow\\tnote{a}", "$<$stand-in$>$ \\& more", "100\\%"});
  EXPECT_EQ(std::count(tex.begin(), tex.end(), '{'), std::count(tex.begin(), tex.end(), '}'));
  EXPECT_EQ(latex_text("a_b<c&d%"), "a\\_b$<$c\\&d\\%");
  EXPECT_EQ(latex_text("[0.7, 1]"), "{[}0.7, 1]")
      << "a row that begins with an option of \\\\ does not compile";
}

TEST(Formats, AsHtml) {
  test::expect_has(html_of(cases()), {"cow<sup>a</sup>", "a &lt;stand-in&gt; &amp; more"});
  EXPECT_EQ(html_text("<a b=\"&\">"), "&lt;a b=&quot;&amp;&quot;&gt;");
}

}  // namespace
}  // namespace pelage
