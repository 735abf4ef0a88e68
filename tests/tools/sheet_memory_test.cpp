// What pictures take of the host's memory.
#include "tests/tools/command_runner.h"

#include <sys/resource.h>

namespace supple::test {
namespace {

class SheetMemory : public CommandTest {};

TEST_F(SheetMemory, DrawingTakesNoMoreDrawForDraw) {
    // Many draws of many materials. While branches on views and materials depended on uniform buffers,
    // lavapipe kept a shader of each: 2 GB.
    const Outcome outcome =
        run("sheet '" SUPPLE_SAMPLE_ASSETS "/wren.glb' --columns 1 --only 0 --cell 32x32 -o sheet.png");
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    rusage used{};
    ASSERT_EQ(getrusage(RUSAGE_CHILDREN, &used), 0);
    EXPECT_LT(used.ru_maxrss, 1000000) << "KiB";
}

} // namespace
} // namespace supple::test
