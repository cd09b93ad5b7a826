#include "quadrille/vectorize.h"
