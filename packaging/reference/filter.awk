# filter.awk: a header as Doxygen is to read it, line by line, so that its warnings name the right line.
#   The comment at a header's top is the file's description.
#   Inline namespaces, which nobody writes, become groups: one for each folder, in two parts where kernel.hpp includes only
#   some of it (SHORTSHOT_FIRMWARE lists these headers).
#   A docstring holds for all declarations behind it up to the next empty line, and for those of the same name behind it
#   that have none: they get a copy of it.
#   Attributes are left out.

function indent_of(text) {
  match(text, /^ */)
  return RLENGTH
}

# What a line declares; is_type: a type with members.
function name_in(code) {
  sub(/^ *(friend |explicit |static |inline |constexpr |SHORTSHOT_INLINE )*/, "", code)
  is_type = code ~ /^(struct|class) /
  if (match(code, /^(struct|class|enum class|enum|using) +[A-Za-z_0-9]+/)) {
    code = substr(code, 1, RLENGTH)
  } else if (match(code, /operator[^a-z]*\(/) || match(code, /[A-Za-z_0-9]+\(/)) {
    return substr(code, RSTART, RLENGTH - 1)
  } else {
    sub(/ *(=|;|,|\[|\{).*/, "", code)
  }
  sub(/.*[^A-Za-z_0-9]/, "", code)
  return code
}

# `float x, y;` as declarations of one variable each: Doxygen documents the first one alone.
function one_by_one(code, text,    type, variable, n, i, all) {
  sub(/;$/, "", code)
  n = split(code, variable, ", ")
  type = variable[1]
  sub(/[A-Za-z_0-9]+( = .*)?$/, "", type)
  sub(type, "", variable[1])
  for (i = 1; i <= n; ++i) all = all "/** " text " */ " type variable[i] "; "
  return all
}

# The docstring so far: said[i] is the one that holds at indentation i, "" for none.
function forget(from,    i) {
  for (i = from; i <= 8; i += 2) said[i] = ""
}

FNR == 1 {
  path = FILENAME
  sub(/.*include\//, "", path)
  parts = split(path, part, "/")
  group = parts > 2 ? part[2] : "basics"
  if (index(" " ENVIRON["SHORTSHOT_FIRMWARE"] " ", " " path " ")) group = group "_firmware"
  scope[0] = "names"  # scope[i]: what stands at indentation i, "names" or something else
  forget(0)
}
FNR == 1 && /^\/\/ shortshot\// {
  sub(/^[^:]*: /, "")
  print "/// @file " path "\n/// " toupper(substr($0, 1, 1)) substr($0, 2)
  in_head = lines_ahead = 1
  next
}
in_head && /^\/\// {
  sub(/^\/\//, "///")
  print
  next
}
{ in_head = 0 }
lines_ahead && /^$/ {
  lines_ahead = 0
  next
}

/^namespace shortshot.* \{/ { is_public = !/detail/ }
/^inline namespace SHORTSHOT_(TYPES|CODE) \{$/ {
  print (is_public ? "/** @addtogroup " group " */ /** @{ */" : "")
  next
}
/^}  \/\/ namespace SHORTSHOT_(TYPES|CODE)$/ {
  print (is_public ? "/** @} */" : "")
  next
}
/^(namespace|}  \/\/ namespace)/ || !is_public || /^#/ {
  print
  next
}

/^$/ {
  forget(0)
  comment = ""
}
/^ *\/\/\/ / {
  if (match($0, /\/\/\/ `[a-z_]+`  +/)) {  # a parameter
    head = substr($0, RSTART, RLENGTH)
    gsub(/[^a-z_]/, "", head)
    $0 = substr($0, 1, RSTART - 1) "/// @param " head " " substr($0, RSTART + RLENGTH)
  }
  text = $0
  sub(/^ *\/\/\/ /, "", text)
  comment = comment (comment == "" ? "" : " ") text
}
/^$/ || /^ *\/\// || /^ *}/ {
  print
  next
}
/^ *(public|private|protected):$/ {
  forget(0)
  print
  next
}

{
  gsub(/\[\[[^]]*\]\] ?/, "")
  indent = indent_of($0)
  code = $0
  sub(/ *\/\/.*/, "", code)
  if (declaration == "" && scope[indent] == "names" && code !~ /^ *static_assert/) {  # a declaration begins
    start = indent
    name = ""
    forget(start + 2)
    if (comment != "") said[start] = comment
  } else if (declaration == "") {
    print
    next
  }
  declaration = declaration " " code
  held = held (held == "" ? "" : "\n") $0
  if (name == "" && (indent > start || code ~ /^ *template/) && code !~ /[;{}]$/) next  # the name is in a line to come
  trailing = match($0, /\/\/\/< /) ? substr($0, RSTART + 5) : ""
  if (name == "") {
    name = name_in(code)
    own = comment != "" ? comment : trailing
    comment = ""
    doc = own != "" ? own : said[start] != "" ? said[start] : first_said[name]
    if (code ~ /^[^(<={]* [A-Za-z_0-9]+( = [^,(<]*)?, .*;$/) {
      held = one_by_one(code, doc)
    } else if (own == "" && doc != "") {
      printf "/** %s */ ", doc
    }
  }
  if (first_said[name] == "" && !is_type) first_said[name] = doc != "" ? doc : trailing
  print held
  held = ""
  if (code ~ /[;{}]$/) {
    if (code ~ /\{$/) scope[start + 2] = is_type ? "names" : "code"
    declaration = ""
  }
}
