// What kernels that deform vertices differ in. Needs deform.h and mapping.glsl of shared/.
layout(constant_id = kMorphsConstant) const bool kMorphs = false;
layout(constant_id = kSkinningConstant) const uint kSkinning = kLinearSkinning;
#ifdef MUSH
const bool kMush = true;
#else
const bool kMush = false;
#endif
