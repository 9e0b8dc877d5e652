// Words for terminals, amounts of memory, and hashes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/byte_size.h"
#include "core/base/error.h"
#include "core/base/fnv1a.h"
#include "core/base/sha256.h"
#include "core/base/terminal_text.h"
#include "core/base/xml_text.h"

namespace dmoscope {
namespace {

TEST(TerminalText, ShowsWhatItMustNotObey) {
  EXPECT_EQ(terminal_line("plain, ümläut, 网格"), "plain, ümläut, 网格");
  EXPECT_EQ(terminal_line("\x1b[31mred\x07"), "\\x1b[31mred\\x07");
  EXPECT_EQ(terminal_line("a\nb\tc\r"), "a\\x0ab\\x09c\\x0d");
  EXPECT_EQ(terminal_lines("a\nb\tc\r"), "a\nb\\x09c\\x0d");
  EXPECT_EQ(terminal_line("\xc2\x9b"
                          "31m\x7f"),
            "\\u{9b}31m\\x7f");
  EXPECT_EQ(terminal_line("\xff\xc3(\xed\xa0\x80"), "\\xff\\xc3(\\xed\\xa0\\x80") << "no UTF-8, and half of a surrogate pair";
  EXPECT_EQ(terminal_line("a\xe2\x80\xae.off"), "a\\u{202e}.off") << "turns the reading direction";
  EXPECT_EQ(terminal_line(std::string_view("\0", 1)), "\\x00");
}

TEST(XmlText, StillKnowsItsLetters) {
  EXPECT_EQ(xml_escaped("<\xc3\xbc&\xff\x1b\xef\xbf\xbf>"), "&lt;\xc3\xbc&amp;\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd&gt;");
}

TEST(ByteSize, AsPeopleWriteIt) {
  EXPECT_EQ(parse_byte_size("1"), 1U);
  EXPECT_EQ(parse_byte_size("500b"), 500U);
  EXPECT_EQ(parse_byte_size("3k"), 3072U);
  EXPECT_EQ(parse_byte_size("800M"), std::uint64_t{800} << 20U);
  EXPECT_EQ(parse_byte_size("2GiB"), std::uint64_t{2} << 30U);
  EXPECT_EQ(parse_byte_size("2gb"), std::uint64_t{2} << 30U);
  EXPECT_EQ(parse_byte_size("1T"), std::uint64_t{1} << 40U);
  for (const char* word : {"", "0", "-1", "1.5G", "G", "2X", "2GG", "2 G", "99999999999999999999", "18446744073709551615k"})
    EXPECT_THROW((void)parse_byte_size(word), UsageError) << word;
}

// The examples of FIPS 180-4, and lengths about a block (by sha256sum).
TEST(Sha256, OfTheStandardsExamples) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(sha256(std::string(55, 'x')), "d5e285683cd4efc02d021a5c62014694958901005d6f71e89e0989fac77e4072");
  EXPECT_EQ(sha256(std::string(56, 'x')), "04c26261370ee7541549d16dee320c723e3fd14671e66a099afe0a377c16888e");
  EXPECT_EQ(sha256(std::string(63, 'x')), "75220b47218278e656f2013bb8f0c455a25eaf01e86c64924e9d48d89776d6f2");
  EXPECT_EQ(sha256(std::string(64, 'x')), "7ce100971f64e7001e8fe5a51973ecdfe1ced42befe7ee8d5fd6219506b5393c");
  EXPECT_EQ(sha256(std::string(65, 'x')), "9537c5fdf120482f7d58d25e9ed583f52c02b4e304ea814db1633ad565aed7e9");
  EXPECT_EQ(sha256(std::string(119, 'x')), "000b48d4edf0fa7bee3c6236ecd2785baa5db4eeb8bb54341b029e0d9fa5fb0c");
  EXPECT_EQ(sha256(std::string(120, 'x')), "13f05a0b594787f5ecd315edc96141bd3243203d1b7d4f0836f37308b276ba98");
}

TEST(Fnv1a, OfItsAuthorsExamples) {
  Fnv1a hash;
  EXPECT_EQ(hash.text(), "cbf29ce484222325");
  hash.add_bytes("foobar");
  EXPECT_EQ(hash.text(), "85944171f73967e8");
}

}  // namespace
}  // namespace dmoscope
