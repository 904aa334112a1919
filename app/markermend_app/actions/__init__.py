"""Every action, declared once; menus, palette and shortcuts are made from them."""
