#include "cage/character.h"
