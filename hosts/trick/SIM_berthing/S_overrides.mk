# Where Pong is installed: `bash ci/install PREFIX` in the root of the checkout. Set PKG_CONFIG_PATH if PREFIX is not
# one that pkg-config knows.
PONG_CFLAGS := $(shell pkg-config --cflags pong)
PONG_LIBS := $(shell pkg-config --libs pong)
PONG_LIBDIR := $(shell pkg-config --variable=libdir pong)

TRICK_CFLAGS += -I$(CURDIR)/../models $(PONG_CFLAGS)
TRICK_CXXFLAGS += -I$(CURDIR)/../models -std=c++17 $(PONG_CFLAGS)
TRICK_USER_LINK_LIBS += $(PONG_LIBS) -Wl,-rpath,$(PONG_LIBDIR)
