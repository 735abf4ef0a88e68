#include "cage/topology.h"
