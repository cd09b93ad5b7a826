#include "quadrille/export.h"
