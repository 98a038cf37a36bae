"""Who may do what: doors that tell who comes, the table of permissions, the guard before all."""
