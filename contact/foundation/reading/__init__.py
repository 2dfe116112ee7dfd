"""Reading files that anybody may have made: regular ones only, of a bounded size, with every entry checked."""
