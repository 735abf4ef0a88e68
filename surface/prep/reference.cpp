#include "surface/prep/reference.h"
