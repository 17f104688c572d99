// SPDX-License-Identifier: Apache-2.0
#include "asterism/io/image_file.hpp"

#include <gtest/gtest.h>

#include "asterism/core/files_for_tests.hpp"
#include "asterism/core/random.hpp"

namespace asterism {
namespace {

template <class Grey>
Raster<Grey> noise(double levels) {
  Raster<Grey> raster(61, 43);
  RandomStream random(1, 0);
  for (Grey& pixel : raster.pixels) pixel = static_cast<Grey>(random.uniform(0, levels));
  return raster;
}

class ImageKinds : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Endings, ImageKinds, testing::Values("png", "tif", "bmp", "pgm"));

TEST_P(ImageKinds, KeepEveryGreyLevel) {
  const TestFolder folder;
  const std::string name = std::string("image.") + GetParam();
  const Raster8 written = noise<std::uint8_t>(256);
  write_image(folder / name, written);
  const Image read = read_image(folder / name);
  ASSERT_TRUE(std::holds_alternative<Raster8>(read));
  EXPECT_EQ(width_of(read), 61);
  EXPECT_EQ(std::get<Raster8>(read).pixels, written.pixels);
}

TEST_P(ImageKinds, CutOffAnywhereAreRefused) {
  const TestFolder folder;
  const std::string name = std::string("image.") + GetParam();
  write_image(folder / name, noise<std::uint8_t>(256));
  const std::string whole = folder.read(name);
  for (const double share : {0.02, 0.3, 0.7, 0.99}) {
    const auto file = folder.write(
        name, whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    const std::string message = input_error_of([&] { static_cast<void>(read_image(file)); });
    EXPECT_TELLS(message, name);
    EXPECT_TELLS(message, "cut off");
  }
}

TEST(ReadImage, KeepsSixteenBits) {
  const TestFolder folder;
  const Raster16 written = noise<std::uint16_t>(65536);
  for (const char* name : {"a.png", "a.tif", "a.pgm"}) {
    write_image(folder / name, written);
    const Image read = read_image(folder / name);
    ASSERT_TRUE(std::holds_alternative<Raster16>(read)) << name;
    EXPECT_EQ(std::get<Raster16>(read).pixels, written.pixels) << name;
  }
}

TEST(WriteImage, PutsTheHighByteFirstInPgmAsTheStandardSays) {
  const TestFolder folder;
  Raster16 raster(2, 1);
  raster.pixels = {0x0102, 0xA0B0};
  write_image(folder / "a.pgm", raster);
  const std::string bytes = folder.read("a.pgm");
  EXPECT_EQ(bytes.substr(0, 2), "P5");
  EXPECT_EQ(bytes.substr(bytes.size() - 4), "\x01\x02\xA0\xB0");
}

TEST(ReadImage, ConvertsColourToGrey) {
  const TestFolder folder;
  std::string pixels;
  for (int i = 0; i < 12; ++i) pixels += "\xC8\xC8\xC8";
  const Image read = read_image(folder.write("colour.ppm", "P6\n4 3\n255\n" + pixels));
  EXPECT_EQ(std::get<Raster8>(read).pixels, std::vector<std::uint8_t>(12, 200));
}

TEST(ReadImage, RefusesACutOffJpegThatTheDecoderWouldFillWithGrey) {
  const TestFolder folder;
  write_image(folder / "a.jpg", noise<std::uint8_t>(256));
  EXPECT_EQ(width_of(read_image(folder / "a.jpg")), 61);
  const std::string whole = folder.read("a.jpg");
  const auto file = folder.write("a.jpg", whole.substr(0, whole.size() / 2));
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(read_image(file)); }), "cut off");
}

TEST(ReadImage, RefusesADamagedByteOfPng) {
  const TestFolder folder;
  write_image(folder / "a.png", noise<std::uint8_t>(256));
  std::string bytes = folder.read("a.png");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  const auto file = folder.write("a.png", bytes);
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(read_image(file)); }), "a checksum does not hold");
}

TEST(ReadImage, NamesWhatIsMissingEmptyOrNoImage) {
  const TestFolder folder;
  const auto fault = [](const std::filesystem::path& file) {
    return input_error_of([&] { static_cast<void>(read_image(file)); });
  };
  EXPECT_TELLS(fault(folder / "none.png"), "none.png: cannot be read: No such file");
  EXPECT_TELLS(fault(folder.write("empty.png", "")), "empty.png: the file is empty");
  EXPECT_TELLS(fault(folder.write("text.png", "hello")), "text.png: is no image of a kind that can be read");
  EXPECT_TELLS(fault(folder.path()), "is a folder");
}

TEST(ListImages, TakesFoldersAndPatternsInTheOrderPeopleCount) {
  const TestFolder folder;
  for (const char* name : {"img10.png", "img2.png", "img1.png", "notes.txt"}) folder.write(name, "");
  const auto names = [](const std::string& named) {
    std::string joined;
    for (const auto& file : list_images(named)) joined += file.filename().string() + " ";
    return joined;
  };
  EXPECT_EQ(names(folder.path().string()), "img1.png img2.png img10.png ");
  EXPECT_EQ(names((folder / "img?.png").string()), "img1.png img2.png ");
  EXPECT_TELLS(input_error_of([&] { static_cast<void>(list_images((folder / "*.bmp").string())); }),
               "no images here");
}

}  // namespace
}  // namespace asterism
