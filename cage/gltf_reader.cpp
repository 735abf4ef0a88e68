#include "cage/gltf_reader.h"
