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
    {"click", "what the surface is there: its part, face and joints; or attach a lantern, an arrow, a sticker"},
    {"F", "the whole figure"},
    {"Space", "play, pause"},
    {"1 2 3 4 5", "shaded, wire, patches, normals, zebra"},
    {"V, Shift + V", "the next view, the one before"},
    {"C", "lines of the cage"},
    {"S", "the cage beside the surface"},
    {"D", "levels of detail, as the camera needs them"},
    {"Z", "freeze the camera that chooses levels"},
    {"J", "joints"},
    {"B", "springs, colliders and painted vertices"},
    {"Ctrl + click on an eye", "that part alone, or all again"},
    {"L", "the studio's look, or fast while something moves"},
    {"O", "open a file; files can be dropped on the window, too"},
    {"E", "write a picture of what is shown"},
    {"K", "copy the command line that makes it"},
    {"P", "the panel"},
    {"F12", "write a picture of the window"},
    {"F1 or ?", "these keys"},
    {"Esc", "close"},
};

} // namespace supple::tools
