"""Labels, units and number formats that commands, pages and figures share."""
