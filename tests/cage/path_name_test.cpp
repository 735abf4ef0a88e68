#include "cage/path_name.h"

#include <gtest/gtest.h>

namespace supple::cage {
namespace {

TEST(PathName, TakesWhatEverySystemTakes) {
    for (const char* name : {"", ".", "..", "a", "a.png", ".hidden", "a..b", " a", "con_crete.png", "console.png",
                             "nulls", "com.png", "com10.png", "lpt.bin", "aux2", "a(1)+b%.png", "\xE5\xAD\x97.png"}) {
        EXPECT_EQ(whyRefusedName(name), "") << name;
    }
}

TEST(PathName, RefusesDevicesOfWindows) {
    for (const char* name : {"NUL", "nul", "Con", "prn.png", "AUX.tar.gz", "con .png", "CONIN$", "conout$", "COM0",
                             "com1.bin", "LPT9", "lpt\xC2\xB2.png", "COM\xC2\xB9"}) {
        EXPECT_EQ(whyRefusedName(name), "path names a device of Windows") << name;
    }
}

TEST(PathName, RefusesDrivesStreamsAndNamesThatWindowsCutsOff) {
    for (const char* name : {"C:", "C:a.png", "a.png:stream", ":"}) {
        EXPECT_EQ(whyRefusedName(name), "path contains a colon, which means a drive or a stream on Windows") << name;
    }
    for (const char* name : {"a.", "a.png ", "...", " ", ".. "}) {
        EXPECT_EQ(whyRefusedName(name), "path has a name that ends in a dot or a space, which Windows leaves out")
            << name;
    }
}

TEST(PathName, RefusesWhatIsNoText) {
    EXPECT_EQ(whyRefusedName(std::string_view("a\0b", 3)), "path contains a NUL character");
    EXPECT_EQ(whyRefusedName("a\nb"), "path contains a control character");
    for (const char* name : {"\xFF", "a\xC3", "\xC0\x80", "\xED\xA0\x80"}) {
        EXPECT_EQ(whyRefusedName(name), "path is not UTF-8");
    }
}

} // namespace
} // namespace supple::cage
