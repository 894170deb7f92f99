#include "storage/answer.h"

#include <gtest/gtest.h>
