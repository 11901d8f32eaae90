#include "pages/code_blocks.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "demos/scratch_folder.h"

namespace octoblisk::pages {
namespace {

TEST(CodeBlocks, areFencedOrIndented) {
  const demos::ScratchFolder folder;
  folder.write("a.md", "Text\n    of prose\n\n    one\n      two\n\n```cpp\n\t~~~\n```\n- text\n");
  const std::vector<CodeBlock> blocks = codeBlocksOf(folder.path(), "a.md");
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_EQ(blocks[0].place() + blocks[0].language + blocks[0].text, "a.md:4one\n  two\n");
  EXPECT_EQ(blocks[1].place() + blocks[1].language + blocks[1].text, "a.md:7cpp\t~~~\n");
}

TEST(CodeBlocks, areRefusedWhereTheyAreSetOtherwise) {
  const demos::ScratchFolder folder;
  for (const char* text :
       {"```\nopen\n", " ```\n", "   ```cpp\n", "~~~\n", "  ~~~\n", "\ttab\n", "  \ttab\n"}) {
    folder.write("a.md", text);
    EXPECT_THROW(codeBlocksOf(folder.path(), "a.md"), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace octoblisk::pages
