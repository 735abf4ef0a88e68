#include "surface/prep/weights.h"
