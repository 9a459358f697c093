// Tokens that need a look at what follows them: numbers with a unit, and `after` on the line of an effect.
#include "tree_sitter/parser.h"

#include <string.h>

enum { NUMBER, PERCENT, LATER };

// made by `make parser`
static const char *const UNITS[] = {
  "m", "km", "cm", "mm", "m2", "m3", "rad", "deg", "s", "us", "ms", "min", "h", "m/s", "km/h",
  "m/s2", "rad/s", "deg/s", "rad/s2", "Hz", "kg", "g", "N", "J", "Wh", "kWh", "W", "kW", "V",
  "mV", "A", "mA", "Ah", "mAh", "degC", NULL,
};
// end

enum { LONGEST = 8 };

void *tree_sitter_swarm_external_scanner_create(void) { return NULL; }
void tree_sitter_swarm_external_scanner_destroy(void *state) { (void)state; }
unsigned tree_sitter_swarm_external_scanner_serialize(void *state, char *buffer) {
  (void)state;
  (void)buffer;
  return 0;
}
void tree_sitter_swarm_external_scanner_deserialize(void *state, const char *buffer, unsigned size) {
  (void)state;
  (void)buffer;
  (void)size;
}

static bool is_digit(int32_t c) { return c >= '0' && c <= '9'; }

static bool is_word(int32_t c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static void skip_blanks(TSLexer *lexer, bool outside) {
  while (lexer->lookahead == ' ' || lexer->lookahead == '\t') lexer->advance(lexer, outside);
}

static void digits(TSLexer *lexer) {
  while (is_digit(lexer->lookahead)) lexer->advance(lexer, false);
}

// Append a word to `text`; what is too long for a unit is read and not kept.
static void word(TSLexer *lexer, char *text) {
  size_t length = strlen(text);
  while (is_word(lexer->lookahead)) {
    if (length < LONGEST) text[length++] = (char)lexer->lookahead;
    text[length] = '\0';
    lexer->advance(lexer, false);
  }
}

static bool is_unit(const char *text) {
  for (const char *const *unit = UNITS; *unit; unit++)
    if (strcmp(*unit, text) == 0) return true;
  return false;
}

// After `%`: an operand makes it a remainder.
static bool operand_follows(TSLexer *lexer) {
  skip_blanks(lexer, false);
  if (is_digit(lexer->lookahead) || lexer->lookahead == '(' || lexer->lookahead == '"') return true;
  if (lexer->lookahead == '-') {
    lexer->advance(lexer, false);
    return lexer->lookahead != '>';
  }
  if (!is_word(lexer->lookahead)) return false;
  char text[LONGEST + 1] = "";
  word(lexer, text);
  if (strcmp(text, "and") == 0 || strcmp(text, "or") == 0) return false;
  if (strcmp(text, "step") != 0) return true;
  if (lexer->lookahead != ' ' && lexer->lookahead != '\t') return true;
  skip_blanks(lexer, false);
  return !(is_word(lexer->lookahead) || strchr("(\"-", (int)lexer->lookahead));
}

static bool number(TSLexer *lexer) {
  digits(lexer);
  lexer->mark_end(lexer);
  if (lexer->lookahead == '.') {
    lexer->advance(lexer, false);
    if (is_digit(lexer->lookahead)) {
      digits(lexer);
      lexer->mark_end(lexer);
    } else {
      return true;
    }
  }
  char text[LONGEST * 2 + 2] = "";
  if (lexer->lookahead == 'e' || lexer->lookahead == 'E') {
    lexer->advance(lexer, false);
    if (lexer->lookahead == '+' || lexer->lookahead == '-') lexer->advance(lexer, false);
    if (!is_digit(lexer->lookahead)) return true;
    digits(lexer);
    lexer->mark_end(lexer);
  }
  skip_blanks(lexer, false);
  word(lexer, text);
  if (text[0] == '\0') return true;
  if (is_unit(text)) lexer->mark_end(lexer);
  if (lexer->lookahead != '/') return true;
  lexer->advance(lexer, false);
  strcat(text, "/");
  word(lexer, text);
  if (is_unit(text)) lexer->mark_end(lexer);
  return true;
}

// `%` where no operand follows: with one, it is the remainder.
static bool percent(TSLexer *lexer) {
  lexer->advance(lexer, false);
  lexer->mark_end(lexer);
  return !operand_follows(lexer);
}

static bool later(TSLexer *lexer) {
  char text[LONGEST + 1] = "";
  word(lexer, text);
  lexer->mark_end(lexer);
  return strcmp(text, "after") == 0;
}

bool tree_sitter_swarm_external_scanner_scan(void *state, TSLexer *lexer, const bool *valid) {
  (void)state;
  // All are valid only where the parser mends an error.
  bool mends = valid[NUMBER] && valid[PERCENT] && valid[LATER];
  skip_blanks(lexer, true);
  if (valid[PERCENT] && lexer->lookahead == '%') {
    lexer->result_symbol = PERCENT;
    return percent(lexer);
  }
  if (valid[LATER] && !mends && lexer->lookahead == 'a') {
    lexer->result_symbol = LATER;
    return later(lexer);
  }
  if (!valid[NUMBER] || mends) return false;
  while (lexer->lookahead == '\r' || lexer->lookahead == '\n' || lexer->lookahead == ' ' || lexer->lookahead == '\t')
    lexer->advance(lexer, true);
  if (!is_digit(lexer->lookahead)) return false;
  lexer->result_symbol = NUMBER;
  return number(lexer);
}
