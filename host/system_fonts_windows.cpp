#include "base/utf8_path.h"
#include "host/system_fonts.h"

#include <filesystem>
#include <system_error>

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

namespace supple::host {

std::vector<FontFile> systemFonts(const std::u32string& /*characters*/) {
    // Windows has no list of fonts by their characters. These it has brought for many years, each for other scripts.
    wchar_t folder[MAX_PATH] = {};
    if (GetWindowsDirectoryW(folder, MAX_PATH) == 0) {
        return {};
    }
    std::vector<FontFile> fonts;
    for (const wchar_t* const file :
         {L"segoeui.ttf", L"msgothic.ttc", L"YuGothM.ttc", L"msyh.ttc", L"simsun.ttc", L"malgun.ttf", L"msjh.ttc",
          L"mingliu.ttc", L"Nirmala.ttf", L"LeelawUI.ttf", L"seguisym.ttf", L"tahoma.ttf"}) {
        const std::filesystem::path path = std::filesystem::path(folder) / L"Fonts" / file;
        if (std::error_code unknown; std::filesystem::exists(path, unknown)) {
            fonts.push_back({utf8Text(path)});
        }
    }
    return fonts;
}

} // namespace supple::host
