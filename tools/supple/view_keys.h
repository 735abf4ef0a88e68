// The keys of the viewer, for its help window and for the command line.
#pragma once

namespace supple::tools {

struct ViewKey {
    const char* keys;
    const char* what;
};
inline constexpr ViewKey kViewKeys[] = {
    {"drag", "turn"},
    {"right drag, Shift + drag", "move"},
    {"wheel", "closer, farther"},
    {"F", "the whole figure"},
    {"Space", "play, pause"},
    {"1 2 3 4 5", "shaded, wire, patches, normals, zebra"},
    {"C", "lines of the cage"},
    {"Ctrl + click on an eye", "that part alone, or all again"},
    {"P", "the panel"},
    {"F1 or ?", "these keys"},
    {"Esc", "close"},
};

} // namespace supple::tools
