// Levels before the budget, in an instance's scratch (shared/lod.h).
#define LOD_CAMERA push.camera
#include "shaders/lod/measure.glsl"
#include "shaders/lod/scratch.glsl"

// The one level of an instance, where it has one.
float levelOfEntry(uint entry) { return uintBitsToFloat(instanceWord(push.window.firstInstance + entry + push.levels)); }
