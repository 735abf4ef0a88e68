#include "skinning/pose.h"
